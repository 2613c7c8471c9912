// Measures each directional sampling strategy for many materials and angles: mean, variance, rays and time
// per sample.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/common/options.h"
#include "bench/sampling/sampler.h"

namespace phlux::bench {

struct SamplingOptions : CommonOptions {
  std::vector<std::string> strategies; ///< names and users' kernel files; empty: all that ship
  std::shared_ptr<const scene::Material>
      material; ///< of another model than the Phong model, to measure instead
  std::vector<std::shared_ptr<const scene::Material>>
      materials;                        ///< of several such models, each to be measured as `material`
  std::vector<Case> cases;              ///< empty: the grid
  std::vector<Light> lights;            ///< empty: all
  bool quick = false;                   ///< thirteen cases
  bool fresh = false;                   ///< do not resume an earlier run
  std::optional<std::uint64_t> samples; ///< per row; default: 2^19, or 2^18 if quick; fewer for `rejection`
                                        ///< where it needs many proposals
  std::optional<double> ray_ns;         ///< cost of a ray for the ranking; default: default_ray_cost()
  std::uint32_t seed = 1;
  std::function<bool()> interrupted; ///< called before each case; may be empty
};

/// `rejection` is left out of cases in which it needs more proposals per sample on average.
inline constexpr double most_proposals = 1000;

/// Four cases whose variances are known by quadrature, then a grid over material, exponent and
/// angle.
[[nodiscard]] std::vector<Case> sampling_cases(bool quick);

/// Angles of incidence, in degrees, at which a material of another model than the Phong model is measured.
inline constexpr double model_angles[] = {0, 30, 60, 75, 85};

/// Writes sampling.csv, with Russian roulette in those strategies that have_roulette();
/// sampling-no-roulette.csv, these strategies without it; and sampling-plain-roulette.csv, the others with
/// it. The strategies alternate, so that other load on the machine affects all alike. Resumes an interrupted
/// run with the same settings. Returns false if interrupted. For a given material the tables are
/// sampling-MODEL.csv and sampling-MODEL-no-roulette.csv: the model's own sampling, cosine and uniform, under
/// constant light, against the reflectivity by quadrature.
/// @throws UsageError, DeviceError, WriteError
[[nodiscard]] bool write_sampling_tables(const SamplingOptions& options);

/// Writes the tables, ranks the strategies (NAME.ranking.csv), prints a summary and the verdict
/// (sampling_verdict.h; NAME.verdict.txt), and writes the charts and the section of the report. @throws as
/// the above; WriteError also if the charts cannot be drawn, when the tables are complete
[[nodiscard]] bool measure_sampling(const SamplingOptions& options);

} // namespace phlux::bench
