// Output of `phlux bench`: tables as text, and charts.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/program.h"
#include "temporary_folder.h"

/// Columns of every table of methods, after the key of the scene.
inline const char* const method_columns =
    ",integrator,strategy,connect_or_weights,device,samples_per_pixel,seconds,relmse,variance_per_sample,"
    "variance_standard_error,top_share,seconds_per_sample,variance_times_seconds,";

[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);
[[nodiscard]] std::vector<std::string> split(const std::string& line);
[[nodiscard]] long columns_of(const std::string& line);
[[nodiscard]] std::string value_of(const std::string& row, const std::vector<std::string>& columns,
                                   const std::string& name);

/// Whether the charts were drawn, by the exit code: without matplotlib they cannot be.
[[nodiscard]] bool has_charts(const Outcome& outcome);

/// An environment in which matplotlib cannot be imported, so that no charts are drawn, which takes seconds.
/// Writes to `folder`.
[[nodiscard]] std::map<std::string, std::string> without_matplotlib(const TemporaryFolder& folder);

/// File of a shipped scene.
[[nodiscard]] std::string shipped(const std::string& name);
