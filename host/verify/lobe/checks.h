// Checks of any reflectance model by its interface (kernels/lobes/lobe.h): its functions against one another.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "measure/device_model.h"
#include "verify/lobe/direction_tree.h"
#include "verify/report.h"

namespace phlux::verify {

/// Largest relative difference of two values or integrals that should be equal: ten times the error in
/// float32 of a power of a cosine with exponent 1000.
inline constexpr double agreement = 1e-3;

/// |a - b| relative to the larger of the two; 0 if it is at most `floor`.
[[nodiscard]] inline double disagreement(double a, double b, double floor) {
  const double off = std::abs(a - b);
  return off <= floor ? 0 : off / std::max(std::abs(a), std::abs(b));
}
inline constexpr double density_floor = 1e-5; // per sr; a uniform density is 0.16

/// One model on one device.
struct LobeSubject {
  const scene::Model& model;
  std::string name; ///< in the report
  const DeviceModel& device;
  std::size_t samples; ///< per material and direction
  bool weighs_by_part; ///< weights may be of the sampled part only, and so correct only in the mean
  Report& report;

  /// Whether a sample has a direction above the surface, or below one that transmits.
  [[nodiscard]] bool counts(const Sample& s) const {
    return s.direction.z > 0 || (model.transmits && s.direction.z < 0);
  }
  void record(const char* check, double figure, double limit, const std::string& where) const {
    report.record(name, check, figure, limit, where);
  }
};

struct LobeCase {
  int material = 0;
  Direction fixed;
  std::string where; ///< the case, in words
  std::uint32_t seed = 0;
};

/// Integrates evaluate over the hemisphere, or the sphere if the model transmits. Checks all of its values:
/// they are finite and not negative, f_r is reciprocal, and densities are the reverse densities with
/// exchanged directions.
[[nodiscard]] DirectionTree integrate_lobe(const LobeSubject& subject, const LobeCase& one);
/// Densities below the surface are finite, as weights need them even where f_r is 0.
void check_below(const LobeSubject& subject, const LobeCase& one);
/// f_r and densities do not depend on the longitude, unless the model declares that it needs tangents.
void check_isotropy(const LobeSubject& subject, const LobeCase& one);

/// Means over samples, and their standard errors.
struct SampleMeans {
  Rgb reflected{0}, reflected_error{0}; ///< weight, without delta events
  Rgb delta{0}, delta_error{0};         ///< weight of delta events
  Rgb all{0}, all_error{0};             ///< weight of both
  double aside = 0, aside_error = 0;    ///< share of samples that are delta events or do not count
  bool trusted = false;                 ///< enough effective samples for normal means
};
/// Samples against evaluate: densities, weights, directions. Values are finite, directions of unit length,
/// delta events declared.
[[nodiscard]] SampleMeans check_lobe_samples(const LobeSubject& subject, const LobeCase& one,
                                             const DirectionTree& tree);

/// The integral of evaluate, the mean of sample's weights and reflectivity against one another; energy.
void check_integrals(const LobeSubject& subject, const LobeCase& one, const DirectionTree& tree,
                     const SampleMeans& means);

/// Density against finite differences, if directions are a smooth one-to-one map of two random numbers.
void check_map(const LobeSubject& subject, const LobeCase& one);

/// First and last random numbers, grazing and normal incidence.
void check_lobe_extremes(const LobeSubject& subject, int material, const std::string& where);

} // namespace phlux::verify
