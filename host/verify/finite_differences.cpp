#include "verify/finite_differences.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace phlux::verify {
namespace {

constexpr int offsets[] = {-2, -1, 1, 2};
constexpr double coefficients[] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12};

Direction derivative(const Sample* samples) {
  Direction sum(0);
  for (int k = 0; k < 4; ++k) sum += coefficients[k] * samples[k].direction;
  return sum / difference_step;
}

} // namespace

std::vector<NumberPair> inner_points() {
  std::vector<NumberPair> list;
  for (const double u1 : {0.15, 0.31, 0.52, 0.68, 0.83})
    for (const double u2 : {0.12, 0.41, 0.57, 0.74, 0.93})
      if (std::abs(u1 - u2) > 0.04 && std::abs(u1 + u2 - 1) > 0.04) list.push_back({u1, u2});
  return list;
}

void append_stencil(std::vector<Words>& words, const NumberPair& point, const Words& others,
                    std::size_t word_1, std::size_t word_2) {
  const auto append = [&](double u1, double u2) {
    words.push_back(others);
    words.back()[word_1] = word_for(u1);
    words.back()[word_2] = word_for(u2);
  };
  append(point.u1, point.u2);
  for (const int k : offsets) append(point.u1 + k * difference_step, point.u2);
  for (const int k : offsets) append(point.u1, point.u2 + k * difference_step);
}

double jacobian(const Sample* stencil) {
  return glm::length(glm::cross(derivative(stencil + 1), derivative(stencil + 5)));
}

double coarse_jacobian(const Sample* stencil, int steps) {
  const int before = steps == 2 ? 1 : 2, after = steps == 2 ? 4 : 3; // of offsets
  const Direction by_u1 = stencil[after].direction - stencil[before].direction,
                  by_u2 = stencil[after + 4].direction - stencil[before + 4].direction;
  return glm::length(glm::cross(by_u1, by_u2)) / (4 * steps * steps * difference_step * difference_step);
}

} // namespace phlux::verify
