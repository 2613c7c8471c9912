// What the libraries call `NAME` is the option --NAME here.
#pragma once

#include <string>

namespace phlux::cli {

/// `text` with options in place of the settings that it names.
[[nodiscard]] std::string with_options(const std::string& text);

} // namespace phlux::cli
