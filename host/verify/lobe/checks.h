// The checks of a reflectance model of which nothing is known but its interface (kernels/lobes/lobe.h): what
// its functions say of one another.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "measure/device_model.h"
#include "verify/lobe/hemisphere_tree.h"
#include "verify/report.h"

namespace phlux::verify {

/// Largest relative difference of two values that should be equal, and of integrals that should be: ten times
/// what float32 makes of a power of a cosine at an exponent of 1000. A contradiction is larger.
inline constexpr double agreement = 1e-3;

/// |a - b| relative to the larger; 0 where both are below `floor` or nearer than it.
[[nodiscard]] inline double disagreement(double a, double b, double floor) {
  const double off = std::abs(a - b);
  return off <= floor ? 0 : off / std::max(std::abs(a), std::abs(b));
}
inline constexpr double density_floor = 1e-5; // per sr; a uniform density is 0.16

[[nodiscard]] inline bool is_finite(const Rgb& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// One model on one device.
struct LobeSubject {
  const scene::Model& model;
  std::string name; ///< in the report
  const DeviceModel& device;
  std::size_t samples; ///< per material and direction
  bool weighs_by_part; ///< a weight may be that of the part that was sampled: right in the mean alone
  Report& report;

  void see(const char* check, double figure, double limit, const std::string& where) const {
    report.see(name, check, figure, limit, where);
  }
};

struct LobeCase {
  int material = 0;
  Direction fixed;
  std::string where; ///< for people
  std::uint32_t seed = 0;
};

/// What evaluate says of the hemisphere. Checks that it is finite and not negative, that f_r is reciprocal,
/// and that each density is the reverse of the other call's, wherever it evaluates.
[[nodiscard]] HemisphereTree integrate_lobe(const LobeSubject& subject, const LobeCase& one);
/// Densities below the surface are finite: weights ask for them, whatever f_r is.
void check_below(const LobeSubject& subject, const LobeCase& one);
/// f_r and densities do not depend on the longitude, unless the model declares that it needs tangents.
void check_isotropy(const LobeSubject& subject, const LobeCase& one);

/// What samples brought.
struct SampleMeans {
  Rgb reflected{0}, reflected_error{0}; ///< E[weight] of what is no delta event, standard errors
  Rgb delta{0}, delta_error{0};         ///< of delta events
  Rgb all{0}, all_error{0};             ///< of both
  double aside = 0, aside_error = 0;    ///< the share of samples that are delta events or below the surface
  bool trusted = false;                 ///< enough samples carry the weight for the means to be normal
};
/// Samples against evaluate: densities, weights, directions; finite values, unit directions, declared delta
/// events.
[[nodiscard]] SampleMeans check_lobe_samples(const LobeSubject& subject, const LobeCase& one,
                                             const HemisphereTree& tree);

/// The integral of evaluate, the mean of sample's weights and reflectivity against one another; energy.
void check_integrals(const LobeSubject& subject, const LobeCase& one, const HemisphereTree& tree,
                     const SampleMeans& means);

/// Density against finite differences, where directions are a smooth map of two random numbers that covers
/// none twice.
void check_map(const LobeSubject& subject, const LobeCase& one);

/// First and last random numbers, grazing and normal incidence.
void check_lobe_extremes(const LobeSubject& subject, int material, const std::string& where);

} // namespace phlux::verify
