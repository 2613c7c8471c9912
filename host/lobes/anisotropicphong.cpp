#include <algorithm>

#include "lobes/shipped.h"

namespace phlux::lobes {
namespace {

// The model reduces its diffuse part as the specular one increases, so that each alone must be at most 1.
double largest_reflectance(const scene::Material& m) {
  return std::max(largest_channel(m.value("diffuse_reflectance")),
                  largest_channel(m.value("specular_reflectance")));
}

std::vector<float> derive(const scene::Material& m, LobeTables&) {
  return {largest_channel(m.value("diffuse_reflectance")), largest_channel(m.value("specular_reflectance"))};
}

} // namespace

const ShippedModel anisotropicphong_model{"anisotropicphong", "lobes/anisotropicphong.cl",
                                          largest_reflectance, derive};

} // namespace phlux::lobes
