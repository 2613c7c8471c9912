// The text of the pages (*.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace phlux::test {

inline const std::filesystem::path source = PHLUX_SOURCE_DIR;

[[nodiscard]] std::vector<std::string> lines_of(const std::filesystem::path& page);
[[nodiscard]] std::string replaced(std::string text, const std::string& what, const std::string& with);
[[nodiscard]] std::string trimmed(const std::string& text); ///< without blanks at its ends
[[nodiscard]] std::vector<std::string> split(const std::string& text, const std::string& at);

} // namespace phlux::test
