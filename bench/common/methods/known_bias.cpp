#include "bench/common/methods/known_bias.h"

#include <algorithm>
#include <utility>

#include "lobes/models.h"
#include "render/first_hits.h"
#include "scene/lights.h"

namespace phlux::bench {

bool shows_delta(scene::Scene scene, const render::Settings& settings) {
  if (!scene::has_delta(scene)) return false;
  // With all other surfaces black, only mirrors and glass have an albedo.
  for (scene::Material& material : scene.materials) {
    scene::Material plain = lobes::diffuse(scene::Rgb(material.model->has_delta ? 1.0 : 0.0));
    plain.two_sided = true;
    plain.opacity = material.opacity;
    plain.opacity_texture = material.opacity_texture;
    material = std::move(plain);
  }
  return std::ranges::any_of(render::first_hits(scene, settings),
                             [](const film::FirstHit& hit) { return hit.mean.albedo[0] > 0.0F; });
}

KnownBias::KnownBias(const scene::Scene& scene, const render::Settings& settings)
    : has_unhittable_lights_(scene::has_unhittable_lights(scene)),
      eye_paths_miss_light_(scene::eye_paths_miss_light(scene)), shows_delta_(shows_delta(scene, settings)) {}

std::string KnownBias::of(const Method& method) const {
  if (method.integrator == "path" && method.variant == "none" && has_unhittable_lights_)
    return "no path can hit a point, spot or directional light";
  if (method.integrator == "path" && eye_paths_miss_light_)
    return "path misses the light that point, spot and directional lights send through mirrors and smooth "
           "glass";
  if (method.integrator == "light" && shows_delta_)
    return "light tracing shows mirrors and smooth glass black, and some are in view";
  if (method.strategy == "lobe-estimate-printed") return "the strategy loses light at grazing angles";
  return {};
}

} // namespace phlux::bench
