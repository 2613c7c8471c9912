// <texture>: bitmap and checkerboard.
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
  /// @throws SceneError for unsupported types or properties, and for images that cannot be read or have
  /// values that are negative or not finite
  [[nodiscard]] scene::TexturePointer read(const Element& texture, const Document& document);
  /// The same of a number: the luminance of a bitmap.
  [[nodiscard]] scene::TexturePointer read_number(const Element& texture, const Document& document);

private:
  using Image = std::shared_ptr<const scene::TexelImage>;
  [[nodiscard]] scene::TexturePointer read(const Element& texture, const Document& document, bool as_number);
  /// Of an image: the exponent of the encoding, or one of the values in textures.cpp; r, g, b, a or y (the
  /// luminance) for one channel in place of all, else empty.
  struct Decoding {
    double gamma;
    std::string channel;
    auto operator<=>(const Decoding&) const = default;
  };
  const Image& image(const std::filesystem::path& file, Decoding decoding, const Location& named_at);

  std::map<std::pair<std::filesystem::path, Decoding>, Image> images_;
};

} // namespace phlux::scene_file
