#include <algorithm>
#include <cstdint>
#include <fstream>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "large_pages.h"

using namespace phlux;

namespace {

// Bytes of the process's address space.
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

} // namespace

TEST_CASE("Memory in large pages is aligned, zero, and writable to its last byte") {
  const auto bytes = GENERATE(std::size_t{1}, large_page / 8, large_page - 1, large_page, 3 * large_page + 1);
  auto* const memory = static_cast<unsigned char*>(map_large_pages(bytes));
  CHECK(reinterpret_cast<std::uintptr_t>(memory) % large_page == 0);
  CHECK(std::all_of(memory, memory + bytes, [](unsigned char byte) { return byte == 0; }));
  std::fill(memory, memory + bytes, static_cast<unsigned char>(1));
  unmap_large_pages(memory, bytes);
}

// A process has 65,530 mappings at most: buffers that leave one behind end a long benchmark.
TEST_CASE("Freed memory leaves nothing of its mapping behind") {
  const auto bytes = GENERATE(std::size_t{1}, large_page / 8 - 1, large_page, 3 * large_page + 1);
  const std::size_t before = address_space();
  REQUIRE(before > 0);
  for (int i = 0; i < 100; ++i) unmap_large_pages(map_large_pages(bytes), bytes);
  CHECK(address_space() < before + large_page);
}

TEST_CASE("Memory that the system does not have is an error") {
  CHECK_THROWS_AS(map_large_pages(std::size_t{1} << 60), std::bad_alloc);
}
