#include "lobes/shipped.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace phlux::lobes {

std::span<const ShippedModel* const> shipped_models() {
#define ADDRESS_OF_MODEL(name) &name##_model,
  static const ShippedModel* const list[] = {PHLUX_SHIPPED_MODELS(ADDRESS_OF_MODEL)};
#undef ADDRESS_OF_MODEL
  return list;
}

const ShippedModel* find_shipped(const scene::Model& model) {
  if (!model.text.empty()) return nullptr;
  for (const ShippedModel* each : shipped_models())
    if (each->name == model.name) return each;
  return nullptr;
}

float largest_channel(const scene::Rgb& rgb) {
  return static_cast<float>(std::max({rgb.r, rgb.g, rgb.b}));
}

float bits_of(int index) {
  return std::bit_cast<float>(static_cast<std::int32_t>(index));
}

} // namespace phlux::lobes
