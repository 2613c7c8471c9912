#include "advice/light_shares.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace phlux::advice {
namespace {

// Calls visit(kind, index, power) for each light.
template<class Scene, class Visit>
void visit_lights(Scene& scene, const Visit& visit) {
  const auto visit_kind = [&](const char* kind, auto& lights, auto power) {
    for (std::size_t i = 0; i < lights.size(); ++i) visit(kind, i, lights[i].*power);
  };
  visit_kind("area", scene.area_emitters, &scene::AreaEmitter::radiance);
  visit_kind("point", scene.point_lights, &scene::PointLight::intensity);
  visit_kind("spot", scene.spot_lights, &scene::SpotLight::intensity);
  visit_kind("directional", scene.directional_lights, &scene::DirectionalLight::irradiance);
  if (scene.constant_radiance) visit("constant", std::size_t{0}, *scene.constant_radiance);
  if (scene.environment) visit("environment map", std::size_t{0}, scene.environment->scale);
}

struct Light {
  std::string name;
  scene::Rgb* power;
};

std::vector<Light> lights_of(scene::Scene& scene) {
  std::vector<Light> lights;
  visit_lights(scene, [&](const std::string& kind, std::size_t index, scene::Rgb& power) {
    lights.push_back({kind == "constant"          ? "constant light"
                      : kind == "environment map" ? kind
                                                  : fmt::format("{} light {}", kind, index + 1),
                      &power});
  });
  return lights;
}

double variance_of_sample(const film::Film& film) {
  double sum = 0.0;
  for (std::size_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    const std::array<double, 3> channels = film.variance_of_mean(pixel);
    sum += std::accumulate(channels.begin(), channels.end(), 0.0);
  }
  return sum * film.samples_per_pixel();
}

} // namespace

std::size_t light_share_renders(const scene::Scene& scene) {
  std::size_t count = 0;
  visit_lights(scene, [&](const char*, std::size_t, const scene::Rgb&) { ++count; });
  return count > 1 && count <= most_lights ? count : 0;
}

std::vector<LightShare> light_shares(scene::Scene& scene, const render::Settings& settings,
                                     const render::Events& events) {
  std::vector<LightShare> shares;
  if (light_share_renders(scene) == 0) return shares;
  const std::vector<Light> lights = lights_of(scene);
  std::vector<scene::Rgb> powers;
  for (const Light& light : lights) powers.push_back(std::exchange(*light.power, scene::Rgb(0.0)));
  double total = 0.0;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    film::Film film(scene.camera.width, scene.camera.height);
    *lights[i].power = powers[i];
    if (powers[i] != scene::Rgb(0.0)) (void)render::render(scene, settings, film, events);
    *lights[i].power = scene::Rgb(0.0);
    shares.push_back({lights[i].name, variance_of_sample(film)});
    total += shares.back().share;
  }
  for (std::size_t i = 0; i < lights.size(); ++i) {
    *lights[i].power = powers[i];
    if (total > 0.0) shares[i].share /= total;
  }
  return shares;
}

} // namespace phlux::advice
