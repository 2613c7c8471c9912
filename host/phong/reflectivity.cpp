#include "phong/reflectivity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace phlux::phong {

double lobe_reflectivity(double exponent, double cosine) {
  const double s2 = (1 - cosine) * (1 + cosine);
  const double clamped = boost::math::ibeta(exponent / 2 + 1, 0.5, s2);
  return cosine * (1 - clamped / 2) + grazing_reflectivity(exponent) * std::pow(s2, exponent / 2 + 1);
}

double grazing_reflectivity(double exponent) {
  return boost::math::tgamma_delta_ratio((exponent + 1) / 2, 0.5) / (2 * std::sqrt(std::numbers::pi));
}

double whole_lobe_cosine(double exponent) {
  return std::min(1.0, 6.0 / std::sqrt(exponent + 1.0));
}

int append_reflectivities(double exponent, std::vector<float>& table) {
  const auto first = static_cast<int>(table.size());
  for (int i = 0; i <= reflectivity_intervals; ++i)
    table.push_back(static_cast<float>(
        lobe_reflectivity(exponent, whole_lobe_cosine(exponent) * i / reflectivity_intervals)));
  return first;
}

} // namespace phlux::phong
