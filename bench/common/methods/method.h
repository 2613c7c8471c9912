// The ways to render a scene that are compared: an integrator, its variant and a directional strategy.
#pragma once

#include <string>
#include <vector>

#include "render/render.h"

namespace phlux::bench {

struct Method {
  std::string integrator; ///< path, light or bidir
  std::string strategy;   ///< how directions are sampled
  std::string variant;    ///< path: --connect; bidir: --weights; light, which has none: "-"

  /// "path mis"; "path mis, fold" where the strategy is not the default.
  [[nodiscard]] std::string name() const;
  bool operator==(const Method&) const = default;
};

/// Every integrator and variant with each strategy, in the order in which tables and charts list them. Of
/// bidir's weights `quick` takes the default alone.
[[nodiscard]] std::vector<Method> all_methods(const std::vector<std::string>& strategies, bool quick);

/// What render() needs to be told; depths are the scene's.
[[nodiscard]] render::Settings settings_of(const Method& method, const scene::RenderDefaults& defaults);

/// Why the method's mean is known to be wrong, in words; empty where it is right.
[[nodiscard]] std::string known_bias(const Method& method, const scene::Scene& scene);

} // namespace phlux::bench
