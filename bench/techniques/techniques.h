// Measures each technique (s, t) of bidirectional path tracing, or of light tracing: its share of the light,
// of the variance and of the rays (Veach 10.2).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/common/methods/image_estimates.h"
#include "bench/common/round_options.h"
#include "film/techniques.h"

namespace phlux::bench {

struct TechniquesOptions : RoundOptions {
  std::string integrator = "bidir"; ///< or light
  std::string weights = "balance";  ///< of bidir
};

/// The technique that stands for all of more than film::most_technique_edges edges.
inline constexpr film::Technique longer_paths{-1, -1};

/// "(1, 3)"; "longer paths".
[[nodiscard]] std::string name_of(const film::Technique& technique);

/// The contribution, the variance and the cost of one technique. A share is a fraction of that of the whole
/// image.
struct TechniqueShare {
  film::Technique technique;
  Estimate light;
  Estimate variance_share;         ///< covariance with the image / variance of the image: all add up to 1
  Estimate variance;               ///< relative, of one sample of the weighted contributions
  Estimate variance_alone;         ///< the same without weights; meaningless for longer_paths
  double rays = 0;                 ///< shadow rays per sample
  double ray_share = 0;            ///< of all rays; the rest are the subpaths'
  std::vector<double> covariances; ///< with the image, by round
};

/// Renders of one scene, round by round: the image, and weighted and unweighted contributions.
struct TechniqueRounds {
  std::vector<ImageEstimate> images;
  struct Contributions {
    std::vector<ImageEstimate> weighted, unweighted;
    double rays = 0; ///< per sample, mean over the rounds
  };
  std::map<film::Technique, Contributions> techniques;
  double rays = 0; ///< of any kind, per sample, mean over the rounds
};

/// In descending order of variance_share.
[[nodiscard]] std::vector<TechniqueShare> technique_shares(const TechniqueRounds& rounds,
                                                           const Reference& reference);

/// Which technique causes most of the variance, or which ones are tied, and what it brings and costs. All of
/// its comparisons hold together with probability 95%.
[[nodiscard]] std::string techniques_answer(const std::vector<TechniqueShare>& shares);

/// Writes techniques.csv (bench/README.md), then its charts and its section of the report. Returns false if
/// interrupted. @throws UsageError, SceneError, DeviceError, WriteError
[[nodiscard]] bool measure_techniques(const TechniquesOptions& options);

} // namespace phlux::bench
