// By which methods random scenes are rendered.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/render.h"
#include "scene/scene.h"

namespace phlux::test {

/// What makes some methods unfit for a scene.
struct SceneFacts {
  double largest_exponent = 0; ///< of lobes
  double brightest = 0;        ///< radiance, or what a light without area sends to a scene's radius away
  double smallest_light = 1;   ///< area of the smallest emitter / that of the scene's largest cross-section
  double narrowest_view = 1;   ///< of what is about the camera, the part that it would see were all as near
                               ///< to it as the nearest thing in view
  double in_small_spots = 0;   ///< part of the lights' power that falls on surfaces next to them: spots that
                               ///< paths from the eye must hit
  bool lights_without_area = false; ///< point, spot or directional: nothing can hit them
};

[[nodiscard]] SceneFacts facts_of(const scene::Scene& scene);

/// The methods for the scenes of a family: `count` (4 or 5) of them, path tracing, path tracing, light
/// tracing, bidirectional, bidirectional. Over the families, every pair of integrator and weights, strategy,
/// width and traversal comes up about equally soon. The first and the fifth sample lobes by their shape; in
/// families with sharp lobes all do.
[[nodiscard]] std::vector<render::Settings> methods_of_family(std::uint64_t family, int count);

/// The method with the scene's depths, and without what the renderer refuses for this scene.
[[nodiscard]] render::Settings for_scene(render::Settings method, const scene::Scene& scene,
                                         const SceneFacts& facts);

/// Whether contributions have no variance in any scene with edges: connections that are weighted alike,
/// whatever their density. Their means take more samples than others to be normal; unlike where there are
/// doubts(), tests have time for them.
[[nodiscard]] bool has_infinite_variance(const render::Settings& method);

/// Why rare samples may carry much of the image, so that no number of samples that a test has time for shows
/// their mean and variance: some paths' contributions are not bounded by a small multiple of the mean. Empty
/// where that is not to be feared.
[[nodiscard]] std::string doubts(const render::Settings& method, const SceneFacts& facts);

/// Such as "bidir power mixture 8 bvh".
[[nodiscard]] std::string name_of(const render::Settings& method);

} // namespace phlux::test
