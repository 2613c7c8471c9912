#include "bench/common/tables/array_file.h"

#include <bit>
#include <cstdint>

#include <fmt/ranges.h>

#include "files/output.h"

namespace phlux::bench {

void write_array(const std::filesystem::path& file, const std::vector<std::size_t>& shape,
                 const std::vector<double>& values) {
  constexpr std::size_t before_header = 10, alignment = 64;
  std::string header =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({},), }}", fmt::join(shape, ", "));
  header.append(alignment - (before_header + header.size() + 1) % alignment, ' ');
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += {'\x01', '\x00', static_cast<char>(header.size() & 0xff), static_cast<char>(header.size() >> 8)};
  bytes += header;
  for (const double value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
  }
  files::write_file(file, bytes);
}

} // namespace phlux::bench
