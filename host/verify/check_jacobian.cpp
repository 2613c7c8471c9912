#include <algorithm>
#include <cmath>

#include "verify/checks.h"
#include "verify/finite_differences.h"

namespace phlux::verify {
namespace {

// The error of fourth-order differences is step^4 / 30 times the fifth derivative, which is below 1e3 in the
// inner part of the square; that of float32 directions is 2^-24 / step, more for narrow lobes.
constexpr double curvature_error = 1e-4;

double float_error(double exponent) { // of a difference quotient, relative to a lobe's width
  return 4 * 0x1p-24 / difference_step * std::sqrt(exponent + 1);
}

} // namespace

void check_jacobian(const Subject& subject) {
  const Strategy& strategy = subject.strategy;
  const bool is_map = strategy.family == Family::smooth || strategy.family == Family::parts ||
                      strategy.family == Family::mixture;
  if (!is_map) return; // fold covers some directions twice; the others draw until a direction is accepted
  std::vector<Words> words;
  for (const NumberPair& p : inner_points())
    append_stencil(words, p, {word_for(0.5), 0, 0, word_for(0.5)}, 1, 2);
  for (const Case& one : subject.cases.cases) {
    const Situation& at = one.at;
    // Only a lobe: with kd > 0 the first number would choose between two maps.
    if (strategy.family != Family::smooth && (at.model.diffuse_max() > 0 || at.model.specular_max() == 0))
      continue;
    const auto samples = subject.device.drive(one.material, at.fixed, words, false);
    double worst = 0;
    for (std::size_t i = 0; i < samples.size(); i += stencil_size)
      worst = std::max(worst, std::abs(samples[i].density * jacobian(&samples[i]) - 1));
    const double exponent = strategy.family == Family::smooth ? 0 : at.model.exponent;
    subject.report.record(strategy.name, "jacobian", worst / (curvature_error + float_error(exponent)), 1,
                          one.name);
  }
}

} // namespace phlux::verify
