// The kernel files that the build put into this binary.
#pragma once

#include <span>
#include <string_view>

namespace phlux::sources {

struct EmbeddedFile {
  std::string_view name; ///< relative to the folder that was embedded
  std::string_view text;
};

[[nodiscard]] std::span<const EmbeddedFile> embedded_files();

} // namespace phlux::sources
