// Input files that are read whole.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace phlux {

/// The bytes of a regular file, or of the one that a link leads to. Nothing if it cannot be read, or is a
/// folder, a pipe or a device, which may block or never end: memory is then bounded by the file's size.
[[nodiscard]] inline std::optional<std::string> bytes_of(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
  const auto size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream) return std::nullopt;
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  if (bytes.size() < size) return std::nullopt;
  return bytes;
}

/// bytes_of() a kernel file, without the carriage returns with which lines end on Windows.
[[nodiscard]] inline std::optional<std::string> kernel_text_of(const std::filesystem::path& file) {
  std::optional<std::string> text = bytes_of(file);
  if (text) std::erase(*text, '\r');
  return text;
}

/// Removes the mark of UTF-8 (EF BB BF) with which some editors begin a text.
inline void remove_byte_order_mark(std::string& text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
}

/// Whether a text begins with the mark of UTF-16, which phlux does not read.
[[nodiscard]] inline bool is_utf16(const std::string& text) {
  return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
}

} // namespace phlux
