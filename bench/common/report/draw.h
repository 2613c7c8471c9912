// Charts and the report (index.html), made by the Python programs of bench/, which the build embeds.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sources/embedded.h"

namespace phlux::bench {

/// Every Python file of bench/, by its path there. Each is a module by its file's name, whatever its folder.
[[nodiscard]] std::span<const sources::EmbeddedFile> embedded_scripts();

/// Runs main() of the Python module `module` ("scenes"), which reads the tables in `folder` and writes its
/// charts and its section of the report there; then writes `folder`/index.html from all sections
/// (bench/README.md). @throws WriteError if no Python with matplotlib is installed, or if the program fails;
/// the tables are complete in either case
void draw_charts(const std::filesystem::path& folder, const std::string& module);

/// Writes the answers of a measurement, a line each, to `folder`/MODULE.verdict.txt, and prints them after
/// the path of its table; then draw_charts(). @throws WriteError
void report_answers(const std::filesystem::path& folder, const std::string& module,
                    const std::vector<std::string>& answers);

} // namespace phlux::bench
