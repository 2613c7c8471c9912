#include "tables/environment_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>

#include "tables/alias_table.h"

namespace phlux::tables {
namespace {

using scene::Rgb;
constexpr double pi = std::numbers::pi;

// Integrals over theta, sin(theta) d theta, of a row's weight in the interpolation that the kernels sample,
// on either side of its centre, divided by the height of a row: of (1 - |t|) sin(theta_row) / sin(theta)
// between rows, and of 1 in the cap about a pole.
struct RowShares {
  RowShares(int row, int height) {
    const double step = pi / height, sine = std::sin((row + 0.5) * step);
    const double cap = one_minus_cosine(step / 2) / step;
    above = row == 0 ? cap : sine / 2;
    below = row == height - 1 ? cap : sine / 2;
  }
  static double one_minus_cosine(double angle) { return 2 * std::pow(std::sin(angle / 2), 2); }
  double above, below;
};

std::uint32_t threshold_of(double probability) {
  return static_cast<std::uint32_t>(std::min(std::ldexp(probability, 32), 4294967295.0));
}

} // namespace

void EnvironmentTable::use_unit(double unit) {
  for (EnvironmentTexel& texel : texels)
    for (float& radiance : texel.radiance) radiance = static_cast<float>(radiance / unit);
  record.density = static_cast<float>(record.density * unit);
}

EnvironmentTable environment_table(const scene::EnvironmentMap& map) {
  EnvironmentTable table;
  const auto width = static_cast<std::size_t>(map.width), height = static_cast<std::size_t>(map.height);
  table.texels.resize(width * height);
  std::vector<double> weights(width * height);
  double sum = 0;
  for (std::size_t row = 0; row < height; ++row) {
    const RowShares shares(static_cast<int>(row), map.height);
    for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
      const Rgb radiance = Rgb(map.texels[i]) * map.scale;
      for (int c = 0; c < 3; ++c) table.texels[i].radiance[c] = static_cast<float>(radiance[c]);
      table.largest = glm::max(table.largest, radiance);
      weights[i] = (radiance.r + radiance.g + radiance.b) / 3 * (shares.above + shares.below);
      sum += weights[i];
    }
  }
  table.integral = sum * 2 * pi / map.width * pi / map.height;
  if (sum > 0) {
    for (double& weight : weights) weight /= sum;
    const AliasTable cells = alias_table(std::move(weights));
    for (std::size_t i = 0; i < cells.keep.size(); ++i) {
      table.texels[i].threshold = threshold_of(cells.keep[i]);
      table.texels[i].alias = cells.alias[i];
    }
  }
  const RowShares first(0, map.height);
  for (int i = 0; i < 3; ++i) {
    table.record.x[i] = static_cast<float>(map.to_world[0][i]);
    table.record.y[i] = static_cast<float>(map.to_world[1][i]);
    table.record.z[i] = static_cast<float>(map.to_world[2][i]);
  }
  table.record.density = static_cast<float>(sum > 0 ? 1 / (3 * table.integral) : 0);
  table.record.cap = static_cast<float>(RowShares::one_minus_cosine(pi / map.height / 2));
  table.record.cap_share = static_cast<float>(first.above / (first.above + first.below));
  table.record.width = map.width;
  table.record.height = map.height;
  return table;
}

} // namespace phlux::tables
