#include "advice/light_shares.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace phlux::advice {
namespace {

struct Light {
  std::string name;
  scene::Rgb* power;
};

std::vector<Light> lights_of(scene::Scene& scene) {
  std::vector<Light> lights;
  const auto add = [&](const char* kind, auto& of_kind, auto power) {
    for (std::size_t i = 0; i < of_kind.size(); ++i)
      lights.push_back({fmt::format("{} light {}", kind, i + 1), &(of_kind[i].*power)});
  };
  add("area", scene.area_emitters, &scene::AreaEmitter::radiance);
  add("point", scene.point_lights, &scene::PointLight::intensity);
  add("spot", scene.spot_lights, &scene::SpotLight::intensity);
  add("directional", scene.directional_lights, &scene::DirectionalLight::irradiance);
  if (scene.constant_radiance) lights.push_back({"constant light", &*scene.constant_radiance});
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

std::size_t lights_told_apart(const scene::Scene& scene) {
  const std::size_t count = scene.area_emitters.size() + scene.point_lights.size() +
                            scene.spot_lights.size() + scene.directional_lights.size() +
                            (scene.constant_radiance ? 1 : 0);
  return count > 1 && count <= most_lights_told_apart ? count : 0;
}

std::vector<LightShare> light_shares(scene::Scene& scene, const render::Settings& settings) {
  std::vector<LightShare> shares;
  if (lights_told_apart(scene) == 0) return shares;
  const std::vector<Light> lights = lights_of(scene);
  std::vector<scene::Rgb> powers;
  for (const Light& light : lights) powers.push_back(std::exchange(*light.power, scene::Rgb(0.0)));
  double total = 0.0;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    film::Film film(scene.camera.width, scene.camera.height);
    *lights[i].power = powers[i];
    if (powers[i] != scene::Rgb(0.0)) (void)render::render(scene, settings, film, {});
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
