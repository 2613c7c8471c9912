// Text from files, for terminals.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace phlux {

/// `text` with '?' for what is not UTF-8 and for what controls a terminal or the direction of writing:
/// control characters of ASCII and Latin 1, and Unicode's format characters U+200B to U+200F, U+2028 to
/// U+202E and U+2060 to U+206F. `lines`: line ends and tabs stay.
[[nodiscard]] inline std::string printable(std::string_view text, bool lines = false) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t at) {
      return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
    };
    const unsigned first = byte(i);
    const std::size_t length = first < 0x80       ? 1
                               : first >> 5 == 6  ? 2
                               : first >> 4 == 14 ? 3
                               : first >> 3 == 30 ? 4
                                                  : 0;
    std::uint32_t code = length > 1 ? first & (0x7FU >> length) : first;
    bool valid = length > 0;
    for (std::size_t k = 1; k < length; ++k) {
      valid = valid && byte(i + k) >> 6 == 2;
      code = code << 6 | (byte(i + k) & 0x3FU);
    }
    constexpr std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};                  // of this length
    valid = valid && code >= smallest[length] && code < 0x110000 && code >> 11 != 0x1B; // surrogates
    const auto within = [code](std::uint32_t from, std::uint32_t to) { return code >= from && code <= to; };
    const bool control = within(0, 0x1F) || within(0x7F, 0x9F) || within(0x200B, 0x200F) ||
                         within(0x2028, 0x202E) || within(0x2060, 0x206F) || code == 0xFEFF;
    const bool kept = valid && (!control || (lines && (code == '\n' || code == '\t')));
    result += kept ? text.substr(i, length) : std::string_view("?");
    i += valid ? length : 1;
  }
  return result;
}

} // namespace phlux
