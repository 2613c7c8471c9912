// Decides whether an interrupted measurement can be resumed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace phlux::bench {

/// Whether `folder` contains tables of measurement `name` with the same settings (`name`.settings.json). If
/// not, or if `fresh`, removes `tables` from the folder and saves the settings. @throws WriteError
[[nodiscard]] bool can_resume(const std::filesystem::path& folder, const std::string& name,
                              const std::vector<std::string>& tables, const nlohmann::json& settings,
                              bool fresh);

} // namespace phlux::bench
