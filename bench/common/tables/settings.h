// Whether what a folder holds was measured with the same settings, and so may be gone on with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace phlux::bench {

/// Whether `folder` holds the beginning of a run of `name` with these settings (NAME.settings.json). Where it
/// does not, or when `fresh`, removes the tables of other settings and notes these. @throws WriteError
[[nodiscard]] bool goes_on(const std::filesystem::path& folder, const std::string& name,
                           const std::vector<std::string>& tables, const nlohmann::json& settings,
                           bool fresh);

} // namespace phlux::bench
