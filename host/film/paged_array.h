// Arrays of numbers that may be larger than memory.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "film/zeroed_memory.h"

namespace phlux::film {

/// Where an array is.
enum class Storage { memory, file };

/// A file without a name, for the life of this object, in the folder that is for large temporary files:
/// $TMPDIR, by default /var/tmp. Its bytes are 0 at first.
class ScratchFile {
public:
  /// Takes the room on the disk. @throws WriteError
  explicit ScratchFile(std::uint64_t bytes);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  /// @throws WriteError
  void read(void* to, std::size_t bytes, std::uint64_t offset) const;
  void write(const void* from, std::size_t bytes, std::uint64_t offset);
  /// Bytes that such files can take; 0 if they would be in memory, as on a tmpfs.
  [[nodiscard]] static double room();
  [[nodiscard]] static const char* folder();

private:
  int descriptor_;
};

/// Numbers that are 0 when they are new. Of a file, only a window is in memory, which moves to each element
/// that is accessed: that is fast for elements in order, and a reference is valid until the next access.
/// In memory, threads may access different elements at the same time; access to a file is for one thread at a
/// time, and throws WriteError.
template<class T>
class PagedArray {
public:
  PagedArray() = default;
  PagedArray(PagedArray&&) = default;
  PagedArray& operator=(PagedArray&&) = default;
  PagedArray(const PagedArray& other) {
    resize(other.size(), other.file_ ? Storage::file : Storage::memory);
    for (std::size_t i = 0; i < size_; ++i) (*this)[i] = other[i];
  }
  PagedArray& operator=(const PagedArray&) = delete;

  /// The array must be empty.
  void resize(std::size_t size, Storage storage) {
    assert(size_ == 0);
    size_ = size;
    if (storage == Storage::file) file_ = std::make_unique<ScratchFile>(std::uint64_t{size} * sizeof(T));
    window_.resize(file_ ? std::min(size, most_in_window) : size);
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] T& operator[](std::size_t i) {
    if (file_) has_changed_ = true;
    return at(i);
  }
  [[nodiscard]] const T& operator[](std::size_t i) const { return at(i); }

  static constexpr std::size_t most_in_window = (std::size_t{1} << 25) / sizeof(T); ///< 32 MB

private:
  T& at(std::size_t i) const {
    assert(i < size_);
    if (i - first_ >= window_.size()) move_to(i);
    return window_[i - first_];
  }
  void move_to(std::size_t i) const {
    if (has_changed_)
      file_->write(window_.data(), in_window() * sizeof(T), std::uint64_t{first_} * sizeof(T));
    first_ = i / most_in_window * most_in_window;
    file_->read(window_.data(), in_window() * sizeof(T), std::uint64_t{first_} * sizeof(T));
    has_changed_ = false;
  }
  [[nodiscard]] std::size_t in_window() const { return std::min(window_.size(), size_ - first_); }

  std::size_t size_ = 0;
  mutable std::size_t first_ = 0;    // in the window
  mutable bool has_changed_ = false; // since the file was read
  mutable std::vector<T, ZeroedMemory<T>> window_;
  std::unique_ptr<ScratchFile> file_; // null: all is in the window
};

/// The elements of an array that is or is not const, in order.
template<class Array>
class Elements {
public:
  struct Iterator {
    using value_type = std::remove_cvref_t<decltype(std::declval<Array&>()[0])>;
    using difference_type = std::ptrdiff_t;
    Array* array = nullptr;
    std::size_t i = 0;
    [[nodiscard]] decltype(auto) operator*() const { return (*array)[i]; }
    Iterator& operator++() {
      ++i;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++i;
      return before;
    }
    bool operator==(const Iterator&) const = default;
  };
  explicit Elements(Array& array) : array_(&array) {}
  [[nodiscard]] Iterator begin() const { return {array_, 0}; }
  [[nodiscard]] Iterator end() const { return {array_, size()}; }
  [[nodiscard]] std::size_t size() const { return array_->size(); }
  [[nodiscard]] decltype(auto) operator[](std::size_t i) const { return (*array_)[i]; }

private:
  Array* array_;
};

} // namespace phlux::film
