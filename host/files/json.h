// JSON text for files and standard output.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace phlux::files {

/// Indented by two spaces, with a line feed at the end. Invalid UTF-8 becomes U+FFFD; NaN and infinity null.
[[nodiscard]] inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace phlux::files
