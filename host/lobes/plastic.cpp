#include <algorithm>
#include <string>

#include "lobes/facets.h"
#include "lobes/shipped.h"

namespace phlux::lobes {
namespace {

double index_of(const scene::Material& m) {
  return m.value("int_ior").x / m.value("ext_ior").x;
}

// The surface and the base together reflect at most the larger of what either would of all light.
double largest_reflectance(const scene::Material& m) {
  return std::max(largest_channel(m.value("diffuse_reflectance")),
                  largest_channel(m.value("specular_reflectance")));
}

std::vector<float> derive_smooth(const scene::Material& m, LobeTables&) {
  return {static_cast<float>(diffuse_reflectance(1 / index_of(m)))};
}

constexpr int intervals = 128; // ROUGHPLASTIC_INTERVALS

// As much of the light inside passes outwards as of that outside inwards, but for the square of the index:
// both are the same integral (Veach 1997, 5.2).
double passing_from_inside(const float* transmittances, double index) {
  double sum = 0; // of T 2 cos, by the trapezoidal rule
  for (int i = 1; i <= intervals; ++i)
    sum += (i == intervals ? 1 : 2) * static_cast<double>(transmittances[i]) * i / intervals;
  return sum / intervals / (index * index);
}

std::vector<float> derive_rough(const scene::Material& m, LobeTables& tables) {
  const double alpha = m.value("alpha").x, index = index_of(m), distribution = m.value("distribution").x;
  const std::string key = "roughplastic " + std::to_string(distribution) + " " + std::to_string(index);
  const auto [row, is_new] = tables.rows.try_emplace({key, alpha}, static_cast<int>(tables.values.size()));
  if (is_new)
    for (const double value :
         rough_transmittances(static_cast<FacetDistribution>(distribution), alpha, index, intervals))
      tables.values.push_back(static_cast<float>(value));
  const double internal =
      m.value("lossy").x > 0.5
          ? rough_internal_reflectance(static_cast<FacetDistribution>(distribution), alpha, index)
          : 1 - passing_from_inside(&tables.values[static_cast<std::size_t>(row->second)], index);
  return {static_cast<float>(internal), bits_of(row->second)};
}

} // namespace

const ShippedModel plastic_model{"plastic", "lobes/plastic.cl", largest_reflectance, derive_smooth};
const ShippedModel roughplastic_model{"roughplastic", "lobes/roughplastic.cl", largest_reflectance,
                                      derive_rough};

} // namespace phlux::lobes
