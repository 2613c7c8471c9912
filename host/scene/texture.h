// Textures: colours that vary with a surface's texture coordinates (u, v).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace phlux::scene {

using Rgb = glm::dvec3;

/// The pixels of an image file, row by row from the top, as bytes or as floats.
struct TexelImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes; ///< R, G, B, 255 per texel
  std::array<float, 256> decoded;  ///< the linear value of a byte
  std::vector<float> floats;       ///< R, G, B per texel, linear
  Rgb smallest{0.0}, largest{0.0}; ///< per channel, linear
};

/// A bitmap or a checkerboard, as Mitsuba's.
struct Texture {
  enum class Wrap : std::uint8_t { repeat, mirror, clamp };
  /// Of a bitmap, whose row 0 is at v = 0; null: a checkerboard.
  std::shared_ptr<const TexelImage> image;
  bool nearest = false; ///< a bitmap's texel that holds (u, v); otherwise interpolation between four
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat; ///< of a bitmap, outside [0, 1]
  /// Of a checkerboard whose squares have the edge 1/2; the first is that of (0, 0) to (1/2, 1/2).
  std::array<Rgb, 2> colors{Rgb(0.4), Rgb(0.2)};
  /// A lookup is at (m0 u + m1 v + m2, m3 u + m4 v + m5).
  std::array<double, 6> to_uv{1, 0, 0, 0, 1, 0};
  double scale = 1; ///< factor of every colour

  [[nodiscard]] Rgb smallest() const {
    return scale * (image ? image->smallest : glm::min(colors[0], colors[1]));
  }
  [[nodiscard]] Rgb largest() const {
    return scale * (image ? image->largest : glm::max(colors[0], colors[1]));
  }
  bool operator==(const Texture&) const = default;
};

using TexturePointer = std::shared_ptr<const Texture>;

} // namespace phlux::scene
