#include "tables/material_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace phlux::render {
namespace {

constexpr int intervals = reflectivity_intervals;

// The cosine from which on a lobe of this exponent is so far above the horizon that it reflects just ks
// cos(theta).
double whole_lobe_cosine(double exponent) {
  return std::min(1.0, 6.0 / std::sqrt(exponent + 1.0));
}

int add_row(std::vector<float>& rows, double exponent) {
  const auto first = static_cast<int>(rows.size());
  for (int i = 0; i <= intervals; ++i)
    rows.push_back(
        static_cast<float>(lobe_reflectivity(exponent, whole_lobe_cosine(exponent) * i / intervals)));
  return first;
}

// Gamma((n + 1) / 2) / (2 sqrt(pi) Gamma(n / 2 + 1)): what the lobe reflects at grazing incidence
// (phong-sampling.md).
double grazing_reflectivity(double exponent) {
  return boost::math::tgamma_delta_ratio((exponent + 1) / 2, 0.5) / (2 * std::sqrt(std::numbers::pi));
}

float largest(const scene::Rgb& rgb) {
  return static_cast<float>(std::max({rgb.r, rgb.g, rgb.b}));
}

int flags_of(const scene::Material& material) {
  int flags = material.kind == scene::Material::Kind::anisotropic_phong ? MATERIAL_ANISOTROPIC : 0;
  if (material.reflects()) flags |= MATERIAL_FRONT | (material.two_sided ? MATERIAL_BACK : 0);
  return flags;
}

} // namespace

double lobe_reflectivity(double exponent, double cosine) {
  const double s2 = (1 - cosine) * (1 + cosine);
  const double clamped = boost::math::ibeta(exponent / 2 + 1, 0.5, s2);
  return cosine * (1 - clamped / 2) + grazing_reflectivity(exponent) * std::pow(s2, exponent / 2 + 1);
}

MaterialTable material_table(const std::vector<scene::Material>& materials) {
  MaterialTable table;
  std::map<double, int> row_of_exponent;
  for (const scene::Material& material : materials) {
    const bool anisotropic = material.kind == scene::Material::Kind::anisotropic_phong;
    MaterialRecord record{};
    for (int i = 0; i < 3; ++i) {
      record.diffuse[i] = static_cast<float>(material.diffuse[i]);
      record.specular[i] = static_cast<float>(material.specular[i]);
    }
    record.exponent = static_cast<float>(material.exponent_u);
    record.exponent_v = static_cast<float>(material.exponent_v);
    record.diffuse_max = largest(material.diffuse);
    record.specular_max = largest(material.specular);
    record.flags = flags_of(material);
    if (!anisotropic && material.specular != scene::Rgb(0.0)) {
      const auto [row, is_new] = row_of_exponent.try_emplace(material.exponent_u, 0);
      if (is_new) row->second = add_row(table.reflectivity, material.exponent_u);
      record.table_row = row->second;
      record.grazing_reflectivity = static_cast<float>(grazing_reflectivity(material.exponent_u));
      record.table_scale = static_cast<float>(intervals / whole_lobe_cosine(material.exponent_u));
    }
    table.records.push_back(record);
  }
  return table;
}

} // namespace phlux::render
