#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "verify/checks.h"
#include "verify/extremes.h"

namespace phlux::verify {

std::vector<Words> extreme_words(bool thin) {
  std::vector<std::uint32_t> few{0u, 0x30000000u, 0xffffffffu};
  if (!thin) few.insert(few.end(), {1u << 9, 0x80000000u, 0xfffffc00u});
  std::vector<Words> words;
  for (const auto x : few)
    for (const auto y : few)
      for (const auto z : few)
        for (const auto w : few) words.push_back({x, y, z, w});
  return words;
}

std::vector<Direction> extreme_directions() {
  return {{0, 0, 1},
          as_float(polar(1e-4, 1)),
          as_float(glm::normalize(Direction(0.6, 0.8, 1e-3))),
          as_float({-0.8, 0.6, 1e-7}),
          {1, 0, 0},
          as_float({0.28, -0.96, 0})};
}

void check_extremes(const Subject& subject) {
  const std::vector<Words> words = extreme_words(subject.samples < thin_samples);
  int last = -1;
  for (const Case& one : subject.cases.cases) {
    if (one.material == last || one.at.model.exponent > subject.strategy.largest_exponent) continue;
    last = one.material;
    for (const Direction& fixed : extreme_directions())
      for (const bool roulette : {false, true}) {
        const auto samples = subject.device.drive(one.material, fixed, words, roulette);
        double wrong = 0, length = 0;
        for (const Sample& s : samples) {
          if (!s.survives) continue;
          if (!is_finite(s.direction) || !is_finite(s.weight) || !std::isfinite(s.density)) ++wrong;
          length = std::max(length, std::abs(glm::length(s.direction) - 1));
        }
        const std::string where =
            fmt::format("kd {:.3g}, ks {:.3g}, n {:g}, fixed ({:.3g} {:.3g} {:.3g}), extreme numbers",
                        one.at.model.diffuse_max(), one.at.model.specular_max(), one.at.model.exponent,
                        fixed.x, fixed.y, fixed.z);
        subject.report.record(subject.strategy.name, "finite", wrong, 0, where);
        subject.report.record(subject.strategy.name, "unit", length, 4 * 0x1p-23, where);
      }
  }
}

} // namespace phlux::verify
