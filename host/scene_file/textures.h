// <texture>: bitmap, checkerboard, and scale around one of them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "scene/texture.h"
#include "scene_file/document.h"

namespace phlux::scene_file {

/// The textures of a scene file. An image file is read once for each way to decode it.
class TextureReader {
public:
  /// A texture of colours or, if `as_number`, of numbers: of a bitmap then the luminance.
  /// @throws SceneError for unsupported types or properties, and for images that cannot be read or have
  /// values that are negative or not finite
  [[nodiscard]] scene::TexturePointer read(const Element& texture, const Document& document,
                                           bool as_number = false);

private:
  [[nodiscard]] scene::TexturePointer read_scaled(const Element& texture, const Document& document,
                                                  bool as_number);

  using Image = std::shared_ptr<const scene::TexelImage>;
  /// How the values of an image are computed from its file.
  struct Decoding {
    double gamma;        ///< exponent of the encoding, or one of the constants in textures.cpp
    std::string channel; ///< r, g, b, a or y (luminance), which replaces all three; empty: each its own
    auto operator<=>(const Decoding&) const = default;
  };
  const Image& image(const std::filesystem::path& file, Decoding decoding, const Location& named_at);

  std::map<std::pair<std::filesystem::path, Decoding>, Image> images_;
};

} // namespace phlux::scene_file
