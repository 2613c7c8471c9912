// A part of an image is what the whole image has there.
#include <catch2/catch.hpp>

#include "images/scenes.h"
#include "scene/image_size.h"

using namespace phlux;
using namespace phlux::test;

namespace {

constexpr scene::Window window{5, 3, 13, 9};

Estimate part_of(const Estimate& whole) {
  Estimate part{window.width, window.height, {}, {}};
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x) {
      const auto pixel = static_cast<std::size_t>((window.y + y) * whole.width + window.x + x);
      part.mean.push_back(whole.mean[pixel]);
      part.variance.push_back(whole.variance[pixel]);
    }
  return part;
}

} // namespace

// Each integrator with another camera and filter. The light paths of a crop are its own, of another number.
TEST_CASE("A crop converges to its part of the whole image") {
  const std::string integrator = GENERATE("path", "light", "bidir");
  scene::Scene scene = shipped("cornell-box", 33, 17);
  scene::Camera& camera = scene.camera;
  camera.principal_x = 0.05;
  if (integrator == "path") camera.aperture_radius = 0.1;
  if (integrator == "light") camera.filter = {scene::Filter::Kind::gaussian, 0.7};
  if (integrator == "bidir") {
    camera.orthographic = true;
    camera.tan_half_fov_x = 1.2;
    camera.filter = {scene::Filter::Kind::tent, 1.0};
  }
  render::Settings settings = settings_for(400);
  settings.integrator = integrator;
  const Estimate whole = estimate_of(render_of(scene, settings).film);
  scene::crop_image(camera, window);
  settings.seed = 1;
  const Agreement result = agreement(estimate_of(render_of(scene, settings).film), part_of(whole));
  INFO(integrator << ": " << result.message);
  CHECK(result.agrees);
}
