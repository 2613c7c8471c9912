#include <algorithm>
#include <cstdint>

#include <catch2/catch.hpp>

#include "large_pages.h"

using namespace phlux;

TEST_CASE("Memory in large pages is aligned, zero, and writable to its last byte") {
  const auto bytes = GENERATE(std::size_t{1}, large_page / 8, large_page - 1, large_page, 3 * large_page + 1);
  auto* const memory = static_cast<unsigned char*>(map_large_pages(bytes));
  CHECK(reinterpret_cast<std::uintptr_t>(memory) % large_page == 0);
  CHECK(std::all_of(memory, memory + bytes, [](unsigned char byte) { return byte == 0; }));
  std::fill(memory, memory + bytes, static_cast<unsigned char>(1));
  unmap_large_pages(memory, bytes);
}

TEST_CASE("Memory that the system does not have is an error") {
  CHECK_THROWS_AS(map_large_pages(std::size_t{1} << 60), std::bad_alloc);
}
