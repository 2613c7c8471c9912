#include <fmt/format.h>

#include "measure/statistics.h"
#include "verify/lobe/checks.h"

namespace phlux::verify {
namespace {

constexpr double certain = 5;               // standard errors of quantities that are compared with a limit
constexpr double largest_quadrature = 5e-3; // largest acceptable error of a quadrature
constexpr double quadrature_errors = 4;     // multiple of the expected error

// The p-value of a mean that differs from its value by `off`, of which `allowed` is the value's own error.
double p_of(double off, double allowed, double error) {
  const double beyond = std::max(0.0, std::abs(off) - allowed);
  return normal_p(beyond == 0 ? 0 : beyond / error);
}

} // namespace

void check_integrals(const LobeSubject& subject, const LobeCase& one, const DirectionTree& tree,
                     const SampleMeans& means) {
  const Integrals total = tree.total();
  const double quadrature = quadrature_errors * tree.error();
  const std::string& where = one.where;
  subject.record("quadrature", tree.error(), largest_quadrature, where);
  const double density = total.density + means.aside;
  subject.record("normalised",
                 std::max(0.0, std::abs(density - 1) - certain * means.aside_error - quadrature), agreement,
                 fmt::format("{}, where it integrates to {:.4g} and should to {:.4g}", where, total.density,
                             1 - means.aside));
  const Rgb stated = subject.device.reflectivity(one.material, std::vector<Direction>{one.fixed}).front();
  for (int channel = 0; channel < 3; ++channel) {
    const double integral = total.reflected[channel], whole = integral + means.delta[channel];
    const double slack = certain * means.delta_error[channel] + quadrature;
    const std::string at =
        fmt::format("{}, channel {}: integral {:.4g}, mean weight {:.4g}, reflectivity {:.4g}", where,
                    channel, whole, means.all[channel], stated[channel]);
    subject.record("energy", whole - slack, 1 + agreement, at);
    if (means.trusted)
      subject.report.record_p(subject.name, "means",
                              p_of(means.reflected[channel] - integral, agreement * integral + quadrature,
                                   means.reflected_error[channel]),
                              at);
    if (subject.model.reflectivity_is_estimate) continue;
    subject.record("reflectivity", std::max(0.0, std::abs(stated[channel] - whole) - slack), agreement, at);
    if (means.trusted)
      subject.report.record_p(subject.name, "weights' mean",
                              p_of(means.all[channel] - stated[channel],
                                   agreement * std::max(1.0, stated[channel]), means.all_error[channel]),
                              at);
  }
}

} // namespace phlux::verify
