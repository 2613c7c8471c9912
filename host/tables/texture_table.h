// Textures as kernels look them up (kernels/scene/textures.cl).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scene/scene_data.h"
#include "scene/texture.h"

namespace phlux::tables {

struct TextureTable {
  std::vector<TextureRecord> records; ///< in the order of the textures
  /// The table of texels by its pieces, which need not be copied to one place: 4-byte words that begin at
  /// `first_word`.
  struct Piece {
    std::size_t first_word = 0;
    std::span<const std::byte> bytes;
  };
  std::vector<Piece> pieces; ///< of the textures' images, which they refer to
  std::size_t words = 0;     ///< of all pieces; kernels count them in 31 bits
};

/// Textures that share an image share its texels.
/// @throws SceneError if the texels are more than kernels can count
[[nodiscard]] TextureTable texture_table(const std::vector<scene::TexturePointer>& textures);

} // namespace phlux::tables
