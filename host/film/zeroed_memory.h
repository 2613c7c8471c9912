// Memory for large arrays of numbers.
#pragma once

#include <cstddef>
#include <new>

#include <sys/mman.h>

namespace phlux::film {

/// Allocates memory that is 0, and takes no room before it is written. Elements must be 0 when they are new:
/// they are not constructed.
template<class T>
struct ZeroedMemory {
  using value_type = T;
  ZeroedMemory() = default;
  template<class Other>
  explicit ZeroedMemory(const ZeroedMemory<Other>&) {}
  bool operator==(const ZeroedMemory&) const = default;

  [[nodiscard]] T* allocate(std::size_t count) {
    void* memory = ::mmap(nullptr, count * sizeof(T), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1,
                          0); // by pages
    if (memory == MAP_FAILED) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) { ::munmap(memory, count * sizeof(T)); }
  void construct(T*) {}
  template<class... Arguments>
  void construct(T* at, const Arguments&... arguments) {
    ::new (static_cast<void*>(at)) T(arguments...);
  }
};

} // namespace phlux::film
