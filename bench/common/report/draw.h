// Drawings by matplotlib and the report of what a folder holds, made by Python programs in this binary.
#pragma once

#include <filesystem>
#include <string_view>

namespace phlux::bench {

/// Runs a script of this folder (scripts.h), which draws charts from the tables in `folder` and writes a
/// section of the report, then writes the report. @throws WriteError where no Python with matplotlib is
/// found, naming the package, or where it fails
void draw_charts(const std::filesystem::path& folder, std::string_view script);

/// Writes `folder`/index.html from the sections there (README.md). @throws WriteError
void write_report(const std::filesystem::path& folder);

} // namespace phlux::bench
