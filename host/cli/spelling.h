// Names of settings in messages: the libraries write `NAME`, the command line --NAME.
#pragma once

#include <string>

namespace phlux::cli {

/// Replaces each setting's name in backquotes by its option.
[[nodiscard]] std::string with_options(const std::string& text);

} // namespace phlux::cli
