// Drawings by matplotlib, in a Python process beside this one.
#pragma once

#include <filesystem>

namespace phlux::bench {

/// Draws figure-1.svg and .png to figure-7 beside the tables in `folder`. @throws WriteError where no Python
/// with matplotlib is found, naming the package, or where it fails
void draw_figures(const std::filesystem::path& folder);

} // namespace phlux::bench
