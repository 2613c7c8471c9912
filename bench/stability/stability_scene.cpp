#include "bench/stability/stability_scene.h"

#include <cmath>
#include <numbers>

#include "lobes/models.h"

#include <glm/geometric.hpp>

namespace phlux::bench {
namespace {

using scene::Rgb;
using scene::Vec3;

enum MaterialIndex { white, red, green, glossy, black };

const Vec3 camera_position(0, 1, 3.9), camera_target(0, 1, 0), lamp(-.6, 2.1, 1.8), lamp_target(.1, .5, -.3);
const Vec3 left_panel(-.5, .75, -.55);
constexpr double lamp_power = 20; // W, red channel

// A square with this centre, normal and half edge length; one edge is horizontal unless the normal is
// vertical.
scene::Patch facing(const Vec3& center, const Vec3& normal, double half, int material) {
  const Vec3 n = glm::normalize(normal);
  const Vec3 up = std::abs(n.y) > 0.9 ? Vec3(0, 0, -1) : Vec3(0, 1, 0);
  const Vec3 u = glm::normalize(glm::cross(up, n));
  return {scene::Patch::Region::parallelogram, center, half * u, half * glm::cross(n, u), {material, -1}};
}

void add_box(scene::Scene& scene) {
  scene.patches.push_back(facing({0, 0, 0}, {0, 1, 0}, 1, white));
  scene.patches.push_back(facing({0, 2, 0}, {0, -1, 0}, 1, white));
  scene.patches.push_back(facing({0, 1, -1}, {0, 0, 1}, 1, white));
  scene.patches.push_back(facing({-1, 1, 0}, {1, 0, 0}, 1, red));
  scene.patches.push_back(facing({1, 1, 0}, {-1, 0, 0}, 1, green));
}

void add_panels(scene::Scene& scene) {
  scene.patches.push_back(facing({.35, .02, .2}, {0, 1, 0}, .35, glossy));
  const Vec3 to_camera = glm::normalize(camera_position - left_panel),
             to_lamp = glm::normalize(lamp - left_panel);
  scene.patches.push_back(facing(left_panel, to_camera + to_lamp, .3, glossy));
}

// One-sided and Lambertian: power = pi radiance area.
void add_lamp(scene::Scene& scene, double radius) {
  const double radiance = lamp_power / std::pow(std::numbers::pi * radius, 2);
  scene.area_emitters.push_back({radiance * Rgb(1, .9, .75)});
  scene::Patch disk = facing(lamp, lamp_target - lamp, radius, black);
  disk.region = scene::Patch::Region::ellipse;
  disk.surface.area_emitter = 0;
  scene.patches.push_back(disk);
}

void aim(scene::Camera& camera) {
  camera.position = camera_position;
  camera.forward = glm::normalize(camera_target - camera_position);
  camera.left = glm::normalize(glm::cross(Vec3(0, 1, 0), camera.forward));
  camera.up = glm::cross(camera.forward, camera.left);
  camera.tan_half_fov_x = std::tan(19 * std::numbers::pi / 180);
}

} // namespace

scene::Scene stability_scene(double exponent, double light_radius, int side) {
  scene::Scene scene;
  scene.materials = {lobes::diffuse(Rgb(.75)), lobes::diffuse(Rgb(.65, .08, .06)),
                     lobes::diffuse(Rgb(.14, .45, .1)), lobes::phong(Rgb(.1), Rgb(.8), exponent),
                     lobes::diffuse(Rgb(0.0))};
  add_box(scene);
  add_panels(scene);
  add_lamp(scene, light_radius);
  aim(scene.camera);
  scene.camera.width = scene.camera.height = side;
  return scene;
}

} // namespace phlux::bench
