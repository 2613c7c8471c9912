// Measures Russian roulette in whole renders: variance x rays of each way to choose the survival probability,
// of sampling strategies with it, and of the edge where it begins.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/common/methods/image_estimates.h"
#include "bench/common/options.h"
#include "render/render.h"

namespace phlux::bench {

struct RouletteOptions : CommonOptions {
  std::vector<std::filesystem::path> scenes;                           ///< empty: shipped_scenes() with lamps
  std::vector<std::string> integrators = settings::integrator_names(); ///< path, light, bidir
  std::vector<std::string> strategies = {"exact"};
  std::vector<std::string> roulettes = {"reflectivity", "kd-ks", "throughput", "efficiency"};
  bool quick = false;                ///< smaller images, fewer samples and rounds
  int samples = 0;                   ///< per pixel and round; 0: 64, or 16 if quick
  std::uint64_t seed = 1;            ///< of the first round
  std::function<bool()> interrupted; ///< may be empty
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
/// with its 95% interval, and those that are not significantly worse. `costs` must have every variant on
/// every scene.
[[nodiscard]] std::vector<std::string> roulette_answers(const std::vector<RouletteCost>& costs);

/// Writes roulette.csv (bench/README.md), then its chart and its section of the report. Returns false if
/// interrupted. @throws UsageError, SceneError, DeviceError, WriteError
[[nodiscard]] bool measure_roulette(const RouletteOptions& options);

} // namespace phlux::bench
