// The methods that render random scenes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/render.h"
#include "scene/scene.h"

namespace phlux::test {

/// Properties of a scene that make some methods inefficient.
struct SceneFacts {
  double largest_exponent = 0; ///< of lobes
  double brightest = 0;        ///< radiance, or what a light without area sends to a scene's radius away
  double smallest_light = 1;   ///< area of the smallest emitter / that of the scene's largest cross-section
  double narrowest_view = 1;   ///< of what is about the camera, the part that it would see were all as near
                               ///< to it as the nearest thing in view
  double in_small_spots = 0;   ///< part of the lights' power that falls on surfaces next to them: spots that
                               ///< paths from the eye must hit
  bool delta = false;          ///< mirrors and smooth glass
  bool lights_without_area = false; ///< point, spot or directional: nothing can hit them
};

[[nodiscard]] SceneFacts facts_of(const scene::Scene& scene);

/// The methods for the scenes of a family: `count` (4 or 5) of them, path tracing, path tracing, light
/// tracing, bidirectional, bidirectional. Over the families, all pairs of integrator and weights, strategy,
/// WIDTH and traversal occur about equally soon. The first and the fifth sample lobes by their shape; in
/// families with sharp lobes all do.
[[nodiscard]] std::vector<render::Settings> methods_of_family(std::uint64_t family, int count);

/// The method with the depths of the scene, and without options that the renderer refuses for it.
[[nodiscard]] render::Settings for_scene(render::Settings method, const scene::Scene& scene,
                                         const SceneFacts& facts);

/// Whether contributions have infinite variance in every scene with edges between surfaces: connections with
/// uniform weights. Their means need more samples to become normal; unlike with doubts(), tests have time for
/// these.
[[nodiscard]] bool has_infinite_variance(const render::Settings& method);

/// Why rare samples may carry much of the image, so that a test has no time for enough samples to estimate
/// mean and variance: the contributions of some paths are not bounded by a small multiple of the mean. Empty
/// if they are.
[[nodiscard]] std::string doubts(const render::Settings& method, const SceneFacts& facts);

/// For example "bidir power mixture 8 bvh".
[[nodiscard]] std::string name_of(const render::Settings& method);

} // namespace phlux::test
