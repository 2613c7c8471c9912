// Measures Russian roulette in whole renders: variance x rays of each way to choose the survival probability,
// of sampling strategies with it, and of the edge where it begins.
#pragma once

#include <string>
#include <vector>

#include "bench/common/methods/image_estimates.h"
#include "bench/common/round_options.h"
#include "render/render.h"

namespace phlux::bench {

/// Without scenes: shipped_scenes() with lamps.
struct RouletteOptions : RoundOptions {
  RouletteOptions() { quick_rounds = 5; }
  std::vector<std::string> integrators = settings::integrator_names(); ///< path, light, bidir
  std::vector<std::string> strategies = {"exact"};
  std::vector<std::string> roulettes = {"reflectivity", "kd-ks", "throughput", "efficiency"};
};

/// One way to render: a strategy with a roulette that begins at an edge, or none (-1).
struct RouletteVariant {
  std::string strategy = render::Settings().strategy;
  render::Roulette roulette = render::Roulette::strategy;
  int rr_depth = render::Settings().rr_depth;

  /// As options of `phlux render`: "--roulette kd-ks --rr-depth 1".
  [[nodiscard]] std::string options() const;
  bool operator==(const RouletteVariant&) const = default;
};

/// The strategy's own roulette first, with which the others are compared; then, for every strategy, each
/// roulette from edges 1 and 5, and none.
[[nodiscard]] std::vector<RouletteVariant> roulette_variants(const RouletteOptions& options);

/// Variance x rays per sample of a variant on one scene by one integrator, relative to the first.
struct RouletteCost {
  std::string scene, integrator;
  RouletteVariant variant;
  Estimate variance, cost, ratio;
  double rays_per_sample = 0;
};

/// For each integrator the variant with the least geometric mean of the ratios over the scenes, as a sentence
/// with its 95% interval, and those that are not significantly worse. A variant that is not measured on every
/// scene is left out. `costs` must have the first variant on every scene.
[[nodiscard]] std::vector<std::string> roulette_answers(const std::vector<RouletteCost>& costs);

/// Writes roulette.csv (bench/README.md), then its chart and its section of the report. Returns false if
/// interrupted. @throws UsageError, SceneError, DeviceError, WriteError
[[nodiscard]] bool measure_roulette(const RouletteOptions& options);

} // namespace phlux::bench
