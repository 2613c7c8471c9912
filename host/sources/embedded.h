// The kernel files embedded in this program.
#pragma once

#include <span>
#include <string_view>

namespace phlux::sources {

struct EmbeddedFile {
  std::string_view name; ///< path relative to the embedded folder
  std::string_view text;
};

[[nodiscard]] std::span<const EmbeddedFile> embedded_files();

} // namespace phlux::sources
