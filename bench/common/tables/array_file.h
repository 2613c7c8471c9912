// Arrays for Python, in NumPy's format (NEP 1, version 1.0).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace phlux::bench {

/// float32, C order; `shape` multiplies to the number of values. @throws WriteError
void write_array(const std::filesystem::path& file, const std::vector<std::size_t>& shape,
                 const std::vector<double>& values);

} // namespace phlux::bench
