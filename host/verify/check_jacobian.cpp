#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "verify/checks.h"

namespace phlux::verify {
namespace {

// Steps in the sampler's two numbers, whole multiples of the 2^-23 that uniform_real resolves.
constexpr double step = 0x1p-7;
// Differences of fourth order err by (step)^4 / 30 times fifth derivatives, which are below 1e3 in the inner
// part of the square; the directions' float32 by 2^-24 / step, more where the lobe is narrow.
constexpr double curvature_error = 1e-4;

double float_error(double exponent) { // of a difference quotient, relative to a lobe's width
  return 4 * 0x1p-24 / step * std::sqrt(exponent + 1);
}

struct Point {
  double u1, u2;
};

// Away from 0 and 1, where the maps have roots, and from the diagonals, where the disk's map has edges.
std::vector<Point> points() {
  std::vector<Point> list;
  for (const double u1 : {0.15, 0.31, 0.52, 0.68, 0.83})
    for (const double u2 : {0.12, 0.41, 0.57, 0.74, 0.93})
      if (std::abs(u1 - u2) > 0.04 && std::abs(u1 + u2 - 1) > 0.04) list.push_back({u1, u2});
  return list;
}

constexpr int offsets[] = {-2, -1, 1, 2};
constexpr double coefficients[] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12};

// All that the differences at one point need: the point, then the steps of u1, then those of u2.
void add_words(std::vector<Words>& words, const Point& p) {
  const auto add = [&](double u1, double u2) {
    words.push_back({word_for(0.5), word_for(u1), word_for(u2), word_for(0.5)});
  };
  add(p.u1, p.u2);
  for (const int k : offsets) add(p.u1 + k * step, p.u2);
  for (const int k : offsets) add(p.u1, p.u2 + k * step);
}

Direction derivative(const Sample* samples) {
  Direction sum(0);
  for (int k = 0; k < 4; ++k) sum += coefficients[k] * samples[k].direction;
  return sum / step;
}

} // namespace

void check_jacobian(const Subject& subject) {
  const Strategy& strategy = subject.strategy;
  const bool is_map = strategy.family == Family::smooth || strategy.family == Family::parts ||
                      strategy.family == Family::mixture;
  if (!is_map) return; // fold covers some directions twice, the others draw until they accept
  std::vector<Words> words;
  for (const Point& p : points()) add_words(words, p);
  for (const Case& one : subject.cases.cases) {
    const Situation& at = one.at;
    // A lobe alone: with kd the first number would choose between two maps.
    if (strategy.family != Family::smooth && (at.model.diffuse_max() > 0 || at.model.specular_max() == 0))
      continue;
    const auto samples = subject.device.drive(one.material, at.fixed, words, false);
    double worst = 0;
    for (std::size_t i = 0; i < samples.size(); i += 9) {
      const Direction by_u1 = derivative(&samples[i + 1]), by_u2 = derivative(&samples[i + 5]);
      const double jacobian = glm::length(glm::cross(by_u1, by_u2)); // solid angle per du1 du2
      worst = std::max(worst, std::abs(samples[i].density * jacobian - 1));
    }
    const double exponent = strategy.family == Family::smooth ? 0 : at.model.exponent;
    subject.report.see(strategy.name, "jacobian", worst / (curvature_error + float_error(exponent)), 1,
                       one.name);
  }
}

} // namespace phlux::verify
