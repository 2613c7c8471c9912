// The checks of one strategy, each in a file of its own. They record figures in the report, which judges
// them.
#pragma once

#include "measure/device_model.h"
#include "verify/cases.h"
#include "verify/report.h"
#include "verify/strategy.h"

namespace phlux::verify {

/// With fewer samples per case, as for interpreters, checks that take no samples are reduced too.
inline constexpr std::size_t thin_samples = 1000;

/// The strategy under test, and the cases and the report that all of its checks use.
struct Subject {
  const Strategy& strategy;
  const DeviceModel& device;
  const Cases& cases;
  const std::vector<CaseCells>& cells; ///< one per case
  std::size_t samples;                 ///< per case
  bool quick;
  Report& report;
};

/// The samples of one case.
struct Drawn {
  const Case& one;
  const CaseCells& cells;
  bool roulette;
  const std::vector<Sample>& samples;
  std::string where; ///< the case, in words
};

/// Samples all cases, with and without roulette, for the checks below.
void check_samples(const Subject& subject);

void check_directions(const Subject& subject,
                      const Drawn& drawn); ///< chi-square against the closed-form density
void check_means(const Subject& subject, const Drawn& drawn, double& pooled,
                 int& pools);                                   ///< E[weight] = reflectivity
void check_weights(const Subject& subject, const Drawn& drawn); ///< f_r cos / (density x survival), bounded
void check_densities(const Subject& subject,
                     const Drawn& drawn); ///< against float64; unit directions, finite

void check_partial(const Subject& subject);  ///< CW 197, section 5: reflectivities through squares of (x, y)
void check_pairs(const Subject& subject);    ///< densities and reverse densities, with either direction fixed
void check_jacobian(const Subject& subject); ///< density against the sampler's finite differences
void check_extremes(const Subject& subject); ///< first and last random numbers, grazing and normal incidence

/// Materials of known variances and of known bias.
[[nodiscard]] std::vector<scene::Material> variance_materials();
/// Variances and bias, with more samples. `device` was built with `materials`, which are
/// variance_materials().
void check_variances(const Subject& subject, const DeviceModel& device,
                     const std::vector<scene::Material>& materials);

/// Cases of the model, independent of the strategy.
struct ModelCases {
  std::vector<scene::Material> materials; ///< first one material per exponent
  std::vector<double> exponents;
};
[[nodiscard]] ModelCases make_model_cases(bool quick);
/// Reflectivity, energy, value, reciprocity and known values. `device` was built with the materials of
/// `cases`; `pairs` pairs of directions are evaluated for each exponent.
void check_model(const DeviceModel& device, const ModelCases& cases, bool quick, std::size_t pairs,
                 Report& report);

} // namespace phlux::verify
