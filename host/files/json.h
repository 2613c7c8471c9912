// JSON as files and standard output get it.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace phlux::files {

/// Indented by two, one line feed at the end. Bytes of names that are not UTF-8 become U+FFFD; NaN and
/// infinity null.
[[nodiscard]] inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace phlux::files
