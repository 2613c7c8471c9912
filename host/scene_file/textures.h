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

private:
  using Image = std::shared_ptr<const scene::TexelImage>;
  /// `gamma`: exponent of the encoding, or one of the values in textures.cpp.
  const Image& image(const std::filesystem::path& file, double gamma, const Location& named_at);

  std::map<std::pair<std::filesystem::path, double>, Image> images_;
};

} // namespace phlux::scene_file
