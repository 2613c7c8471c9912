// The messages between the processes of a render. These run the same program on machines of the same kind:
// numbers are sent as they are in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace phlux::cluster {

enum class Kind : std::uint64_t {
  choices, ///< to a worker: the options of the render
  begin,   ///< to a worker: its first launches are about to come
  launch,
  abandon, ///< to a worker: forget all launches
  end,     ///< to a worker: the render is done
  ready,   ///< from a worker: it can take launches
  result,
  failure,
};

/// A whole number of 8-byte words.
struct Message {
  std::shared_ptr<std::byte[]> bytes;
  std::size_t size = 0; ///< bytes
};

/// Writes values one after another, each at a multiple of 8 bytes.
class Packer {
public:
  explicit Packer(std::byte* to) : to_(to) {} ///< null: only counts
  template<class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    add_array(&value, 1);
  }
  void add(const std::string& text) {
    add(std::uint64_t{text.size()});
    add_array(text.data(), text.size());
  }
  template<class T>
  void add_array(const T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t bytes = count * sizeof(T);
    if (to_ != nullptr && bytes > 0) std::memcpy(to_ + size_, values, bytes);
    size_ += (bytes + 7) / 8 * 8;
  }
  [[nodiscard]] std::size_t size() const { return size_; }

private:
  std::byte* to_;
  std::size_t size_ = 0;
};

/// The message that `write` writes, which is called twice. @throws std::bad_alloc
[[nodiscard]] Message packed(Kind kind, const std::function<void(Packer&)>& write = {});

/// Reads what a Packer wrote. Values beyond the end are 0.
class Unpacker {
public:
  explicit Unpacker(const Message& message) : message_(message) {}
  template<class T>
  [[nodiscard]] T take() {
    T value{};
    if (T* const found = take_array<T>(1)) std::memcpy(&value, found, sizeof(T));
    return value;
  }
  [[nodiscard]] std::string take_text() {
    const auto size = take<std::uint64_t>();
    const char* const text = take_array<char>(size);
    return text != nullptr ? std::string(text, size) : std::string();
  }
  /// `count` values in the message's own memory; null if it has fewer.
  template<class T>
  [[nodiscard]] T* take_array(std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count > (message_.size - at_) / sizeof(T)) return nullptr;
    T* const values = reinterpret_cast<T*>(message_.bytes.get() + at_);
    at_ += (count * sizeof(T) + 7) / 8 * 8;
    return values;
  }

private:
  const Message& message_;
  std::size_t at_ = 0;
};

} // namespace phlux::cluster
