// The entry: a scene and settings in, samples on a film out.
#pragma once

#include <functional>
#include <string>

#include "film/film.h"
#include "render/statistics.h"
#include "scene/scene.h"
#include "settings/settings.h"

namespace phlux::render {

using settings::Connect;
using settings::connect_names;
using settings::Integrator;
using settings::LightSelection;
using settings::Settings;
using settings::strategy_names;
using settings::Traversal;
using settings::wants_light_tree;
using settings::Weights;
using settings::weights_names;

struct Events {
  std::function<void()> building_kernels; ///< building has taken longer than 200 ms
  std::function<void(const std::string&)>
      warning; ///< what the settings make of the scene without being wrong
  /// Called between launches, at most every 50 ms or so; false ends the render, keeping what the film has.
  std::function<bool(const Progress&)> progress;
};

/// Adds samples to `film`, which has the camera's width and height; where an earlier render of the scene with
/// these settings had come to `from`, the film is the one that it left, and the samples, seconds and counts
/// include its own. One device then makes the film that it would have made without a break, bit for bit.
/// @throws UsageError for settings that cannot work, SceneError for a scene that cannot be rendered,
/// DeviceError
[[nodiscard]] Statistics render(const scene::Scene& scene, const Settings& settings, film::Film& film,
                                const Events& events, const RenderState& from = {});

} // namespace phlux::render
