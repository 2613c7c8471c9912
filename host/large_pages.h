// Memory in large pages. A processor translates addresses page by page and remembers the translations of
// about 2,000 pages: of 8 MB in pages of 4 KiB. Where more memory is accessed at random, most of the time
// goes into translations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>

#include <sys/mman.h>

namespace phlux {

inline constexpr std::size_t large_page = std::size_t{2} << 20; ///< bytes

/// Bytes: a multiple of the size of small pages, which is 4 to 64 KiB.
inline constexpr std::size_t small_page = std::size_t{64} << 10;

/// Bytes that map_large_pages() takes from the system for `bytes`: small arrays stay in small pages.
[[nodiscard]] constexpr std::size_t mapped_size(std::size_t bytes) {
  const std::size_t page = bytes < large_page / 8 ? small_page : large_page;
  return (bytes + page - 1) / page * page;
}

/// Memory that is 0 and takes no room before it is written, at a multiple of large_page. Its pages are large
/// if the system has such pages. @throws std::bad_alloc
[[nodiscard]] inline void* map_large_pages(std::size_t bytes) {
  const std::size_t size = mapped_size(bytes);
  void* const mapped =
      ::mmap(nullptr, size + large_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  const std::size_t before =
      (large_page - reinterpret_cast<std::uintptr_t>(mapped) % large_page) % large_page;
  std::byte* const memory = static_cast<std::byte*>(mapped) + before;
  if (before > 0) ::munmap(mapped, before);
  ::munmap(memory + size, large_page - before);
#ifdef MADV_HUGEPAGE
  ::madvise(memory, size, MADV_HUGEPAGE); // a kernel without large pages refuses
#endif
  return memory;
}

/// Frees what map_large_pages(bytes) returned.
inline void unmap_large_pages(void* memory, std::size_t bytes) {
  ::munmap(memory, mapped_size(bytes));
}

} // namespace phlux
