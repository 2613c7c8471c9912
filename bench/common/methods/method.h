// The rendering methods that are compared: integrator, variant of it, and directional strategy.
#pragma once

#include <string>
#include <vector>

#include "render/render.h"

namespace phlux::bench {

struct Method {
  std::string integrator; ///< path, light or bidir
  std::string strategy;   ///< for sampling directions
  std::string variant;    ///< of path: connect; of bidir: weights; "-" for light

  /// "path mis", or "path mis, fold" if the strategy is not the default one.
  [[nodiscard]] std::string name() const;
  bool operator==(const Method&) const = default;
};

/// Every integrator and variant with each strategy, in the order of tables and charts. If `quick`, bidir only
/// with its default weights.
[[nodiscard]] std::vector<Method> all_methods(const std::vector<std::string>& strategies, bool quick);

/// Settings of render() for the method, with the depths of the scene.
[[nodiscard]] render::Settings settings_of(const Method& method, const scene::RenderDefaults& defaults);

} // namespace phlux::bench
