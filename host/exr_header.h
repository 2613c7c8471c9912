// What the header of an OpenEXR file claims, for which OpenEXR allocates memory before it reads on.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>

namespace phlux {

/// "attribute NAME claims N bytes" for the first attribute that is longer than the rest of the file or of
/// another length than its type, or a text of a list of texts that is longer than this list. Nothing if there
/// is none, or no header.
[[nodiscard]] inline std::optional<std::string> false_claim(const std::filesystem::path& file) {
  std::error_code error;
  const std::uint64_t bytes = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(4); // after the magic number
  const auto name = [&] {
    std::string text;
    for (char c{}; text.size() < 256 && stream.get(c) && c != '\0';) text += c;
    return text;
  };
  const auto number = [&] {
    std::array<unsigned char, 4> b{};
    stream.read(reinterpret_cast<char*>(b.data()), b.size());
    return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 |
           std::uint32_t{b[3]} << 24;
  };
  static const std::map<std::string, std::uint32_t> sizes = {{"box2f", 16},
                                                             {"box2i", 16},
                                                             {"chromaticities", 32},
                                                             {"compression", 1},
                                                             {"deepImageState", 1},
                                                             {"double", 8},
                                                             {"envmap", 1},
                                                             {"float", 4},
                                                             {"int", 4},
                                                             {"keycode", 28},
                                                             {"lineOrder", 1},
                                                             {"m33d", 72},
                                                             {"m33f", 36},
                                                             {"m44d", 128},
                                                             {"m44f", 64},
                                                             {"rational", 8},
                                                             {"tiledesc", 9},
                                                             {"timecode", 8},
                                                             {"v2d", 16},
                                                             {"v2f", 8},
                                                             {"v2i", 8},
                                                             {"v3d", 24},
                                                             {"v3f", 12},
                                                             {"v3i", 12}};
  const auto claims = [](const std::string& attribute, std::uint32_t size) {
    return "attribute " + attribute + " claims " + std::to_string(size) + " bytes";
  };
  constexpr std::uint32_t multi_part = 0x1000;
  const bool more_headers = (number() & multi_part) != 0; // up to an empty one
  bool header_has_ended = false;
  while (!error && stream) {
    const std::string attribute = name();
    if (attribute.empty() && (header_has_ended || !more_headers)) break;
    header_has_ended = attribute.empty();
    if (header_has_ended) continue;
    const std::string type = name();
    const std::uint32_t size = number();
    if (!stream) break;
    const auto begin = static_cast<std::uint64_t>(stream.tellg());
    if (size > bytes - begin) return claims(attribute, size);
    // OpenEXR reads these by their own length, whatever the attribute claims, and goes on after them.
    if (const auto known = sizes.find(type); known != sizes.end() && known->second != size)
      return claims(attribute, size);
    if (type == "chlist") {
      constexpr std::streamoff of_channel = 16; // bytes after its name
      while (stream && !name().empty()) stream.seekg(of_channel, std::ios::cur);
      if (!stream || static_cast<std::uint64_t>(stream.tellg()) != begin + size)
        return claims(attribute, size);
    }
    for (std::uint64_t at = begin; type == "stringvector" && at < begin + size;) {
      const std::uint32_t length = number();
      at += 4 + std::uint64_t{length};
      if (at > begin + size) return claims(attribute, length);
      stream.seekg(static_cast<std::streamoff>(at));
    }
    stream.seekg(static_cast<std::streamoff>(begin + size));
  }
  return std::nullopt;
}

} // namespace phlux
