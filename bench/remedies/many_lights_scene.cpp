#include "bench/remedies/many_lights_scene.h"

#include <cmath>
#include <numbers>
#include <random>

#include "lobes/models.h"

#include <glm/geometric.hpp>

namespace phlux::bench {
namespace {

using scene::Rgb;
using scene::Vec3;

constexpr double lamp_radius = 0.05;

scene::Patch lamp(const Vec3& center, int emitter) { // faces down
  return {scene::Patch::Region::ellipse,
          center,
          lamp_radius * Vec3(1, 0, 0),
          lamp_radius * Vec3(0, 0, 1),
          {1, emitter}};
}

} // namespace

scene::Scene many_lights_scene(int lights, int side) {
  scene::Scene scene;
  scene.materials = {lobes::phong(Rgb(.6, .55, .5), Rgb(.1), 20), lobes::diffuse(Rgb(0))};
  const double half = std::sqrt(static_cast<double>(lights)) / 2;
  scene.patches.push_back(
      {scene::Patch::Region::parallelogram, Vec3(0), half * Vec3(0, 0, 1), half * Vec3(1, 0, 0), {0, -1}});
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> place(-half, half), decades(0, 2);
  for (int i = 0; i < lights; ++i) {
    scene.area_emitters.push_back({std::pow(10, decades(generator)) * Rgb(10, 9, 7)});
    const double x = place(generator), z = place(generator);
    scene.patches.push_back(lamp({x, 1, z}, i));
  }
  scene.camera.position = Vec3(0, .7, 0);
  scene.camera.forward = glm::normalize(Vec3(0, -.7, 1.5));
  scene.camera.left = Vec3(1, 0, 0);
  scene.camera.up = glm::cross(scene.camera.forward, scene.camera.left);
  scene.camera.tan_half_fov_x = std::tan(35 * std::numbers::pi / 180);
  scene.camera.width = scene.camera.height = side;
  return scene;
}

} // namespace phlux::bench
