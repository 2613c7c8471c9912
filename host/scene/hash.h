// Hashes of textures and materials, by which equal ones are found among many.
#pragma once

#include <cstddef>
#include <functional>

#include "scene/model.h"

namespace phlux::scene {

/// Combines hashes of numbers; equal numbers, as 0 and -0, have equal hashes.
class Hash {
public:
  template<class Value>
  Hash& add(const Value& value) {
    constexpr std::size_t golden_ratio = 0x9e3779b97f4a7c15; // Boost's hash_combine
    value_ ^= std::hash<Value>()(value) + golden_ratio + (value_ << 6) + (value_ >> 2);
    return *this;
  }
  Hash& add(const Rgb& color) { return add(color.r).add(color.g).add(color.b); }
  [[nodiscard]] std::size_t value() const { return value_; }

private:
  std::size_t value_ = 0;
};

/// Equal for equal textures.
[[nodiscard]] inline std::size_t hash_of(const Texture& texture) {
  Hash hash;
  hash.add(texture.image.get()).add(texture.scale).add(texture.nearest);
  for (const Rgb& color : texture.colors) hash.add(color);
  for (const double number : texture.to_uv) hash.add(number);
  return hash.value();
}

/// Equal for equal materials.
[[nodiscard]] inline std::size_t hash_of(const Material& material) {
  Hash hash;
  hash.add(material.model.get()).add(material.two_sided).add(material.opacity);
  for (const Rgb& value : material.values) hash.add(value);
  for (const TexturePointer& texture : material.textures)
    if (texture) hash.add(hash_of(*texture));
  if (material.opacity_texture) hash.add(hash_of(*material.opacity_texture));
  return hash.value();
}

} // namespace phlux::scene
