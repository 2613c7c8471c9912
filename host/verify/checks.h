// The checks of one strategy, each in a file of its own. They see figures into the report and judge nothing.
#pragma once

#include "measure/device_model.h"
#include "verify/cases.h"
#include "verify/report.h"
#include "verify/strategy.h"

namespace phlux::verify {

/// What the checks of one strategy share.
/// Below so many samples per case the checks that count none of them are thinned out too: for interpreters.
inline constexpr std::size_t thin_samples = 1000;

struct Subject {
  const Strategy& strategy;
  const DeviceModel& device;
  const Cases& cases;
  const std::vector<CaseCells>& cells; ///< one per case
  std::size_t samples;                 ///< per case
  bool quick;
  Report& report;
};

/// Samples that were drawn for one case.
struct Drawn {
  const Case& one;
  const CaseCells& cells;
  bool roulette;
  const std::vector<Sample>& samples;
  std::string where; ///< for people
};

/// Draws for all cases, with and without roulette, and asks the checks below about them.
void check_samples(const Subject& subject);

void check_directions(const Subject& subject,
                      const Drawn& drawn); ///< chi-square against the closed-form density
void check_means(const Subject& subject, const Drawn& drawn, double& pooled,
                 int& pools);                                     ///< E[weight] = reflectivity
void check_weights(const Subject& subject, const Drawn& drawn);   ///< f_r cos / (density x survival), bounded
void check_densities(const Subject& subject, const Drawn& drawn); ///< float64's, unit vectors, finite numbers

void check_partial(const Subject& subject);  ///< CW 197, section 5: reflectivities through squares of (x, y)
void check_pairs(const Subject& subject);    ///< stated densities, with either direction fixed
void check_jacobian(const Subject& subject); ///< density against the sampler's finite differences
void check_extremes(const Subject& subject); ///< first and last random numbers, grazing and normal incidence

/// Materials of known variances and of known bias.
struct VarianceCases {
  std::vector<scene::Material> materials;
};
[[nodiscard]] VarianceCases make_variance_cases();
/// Longer runs. `device` was built with the table of `cases`.
void check_variances(const Subject& subject, const DeviceModel& device, const VarianceCases& cases);

/// Of the model, whatever the strategy.
struct ModelCases {
  std::vector<scene::Material> materials; ///< first one material per exponent
  std::vector<double> exponents;
};
[[nodiscard]] ModelCases make_model_cases(bool quick);
/// Reflectivity, energy, value, reciprocity and known values. `device` was built with the table of `cases`;
/// `pairs` of directions are evaluated for each exponent.
void check_model(const DeviceModel& device, const ModelCases& cases, bool quick, std::size_t pairs,
                 Report& report);

} // namespace phlux::verify
