// Memory for large arrays of numbers.
#pragma once

#include <cstddef>
#include <new>

#include "large_pages.h"

namespace phlux::film {

/// Allocates memory that is 0, and takes no room before it is written; in large pages, since splats are added
/// at random pixels. Elements must be 0 when they are new: they are not constructed.
template<class T>
struct ZeroedMemory {
  using value_type = T;
  ZeroedMemory() = default;
  template<class Other>
  explicit ZeroedMemory(const ZeroedMemory<Other>&) {}
  bool operator==(const ZeroedMemory&) const = default;

  [[nodiscard]] T* allocate(std::size_t count) { return static_cast<T*>(map_large_pages(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) { unmap_large_pages(memory, count * sizeof(T)); }
  void construct(T*) {}
  template<class... Arguments>
  void construct(T* at, const Arguments&... arguments) {
    ::new (static_cast<void*>(at)) T(arguments...);
  }
};

} // namespace phlux::film
