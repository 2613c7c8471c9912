// The header of a PLY file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene_file/location.h"

namespace phlux::scene_file {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] std::size_t byte_size(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count_type; ///< for lists: type of the number of entries
};

struct PlyElement {
  std::string name;
  std::uint64_t rows = 0;
  std::vector<PlyProperty> properties;
  int line = 0;
};

struct PlyHeader {
  enum class Format { ascii, little_endian, big_endian };
  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0; ///< bytes, including the line end after end_header
  int lines = 0;
};

/// @throws SceneError at the line that is wrong
[[nodiscard]] PlyHeader read_ply_header(std::string_view bytes, Location where);

} // namespace phlux::scene_file
