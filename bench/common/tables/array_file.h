// Arrays in the file format of NumPy (NEP 1, version 1.0).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace phlux::bench {

/// Writes float32 values in C order; the product of `shape` is the number of values. @throws WriteError
void write_array(const std::filesystem::path& file, const std::vector<std::size_t>& shape,
                 const std::vector<double>& values);

} // namespace phlux::bench
