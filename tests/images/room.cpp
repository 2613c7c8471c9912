#include "images/room.h"

#include <algorithm>
#include <stdexcept>

#include <glm/geometric.hpp>

namespace phlux::test {

using scene::Rgb;
using scene::Vec3;

namespace {

enum Materials { floor_material, glossy, black, both_sides, brushed };
enum Emitters { of_rectangle, of_mesh, of_disk, of_sphere, of_inside, of_flipped };

scene::Material brushed_metal() {
  return lobes::anisotropic_phong(Rgb(0.3, 0.2, 0.1), Rgb(0.3, 0.4, 0.5), 10, 30);
}

void add_shapes(scene::Scene& scene) {
  scene.patches = {square({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 3, {floor_material, -1})};
  // Also seen from behind: it reflects light to what is above it.
  scene.patches.push_back(
      square({-1.4, 1.2, -1}, glm::normalize(Vec3(1, 0, -2)), {0, 1, 0}, 0.6, {both_sides, -1}));
  scene.patches.push_back({scene::Patch::Region::ellipse,
                           {1.3, 0.7, -0.9},
                           0.6 * glm::normalize(Vec3(2, 0, 1)),
                           0.5 * glm::normalize(Vec3(-0.3, 1, 0.6)),
                           {brushed, -1}});
  scene.spheres = {{{0.1, 0.9, -0.7}, 0.5, false, {glossy, -1}}};
  scene.meshes = {smooth_ball({-0.4, 0.8, 0.8}, 0.4, floor_material)};
}

// Each emitter has a different colour, so that mistaking one for another changes the image.
void add_lights(scene::Scene& scene) {
  scene.area_emitters = {{Rgb(9, 6, 3)}, {Rgb(8, 9, 2)},       {Rgb(6, 8, 10)},
                         {Rgb(5, 3, 4)}, {Rgb(0.5, 0.7, 0.6)}, {Rgb(7, 7, 7)}};
  scene.patches.push_back({scene::Patch::Region::parallelogram,
                           {0.5, 2.6, 0.3},
                           {0.4, 0, 0},
                           {0, 0, 0.3},
                           {black, of_rectangle}});
  scene.meshes.push_back({{{-1.5, 2.3, 0.2}, {-1, 2.5, 0.4}, {-1.2, 2.4, -0.3}, {-1.9, 2.5, 0.7}},
                          {},
                          {{0, 2, 1}, {0, 1, 3}},
                          {black, of_mesh}});
  scene.patches.push_back(
      {scene::Patch::Region::ellipse, {1.5, 2.5, 0.4}, {0.3, 0.1, 0}, {0, 0, 0.4}, {black, of_disk}});
  scene.spheres.push_back({{-0.3, 2.5, 1.2}, 0.3, false, {black, of_sphere}});
  scene.point_lights = {{{0.2, 2.2, -0.3}, Rgb(3, 2, 4)}};
  scene.spot_lights = {{{1, 2.5, 1}, glm::normalize(Vec3(-0.5, -2.5, -0.9)), Rgb(9, 7, 8), 0.7, 0.4}};
  scene.directional_lights = {{glm::normalize(Vec3(0.5, -2, -1)), Rgb(1, 1.5, 0.8)}};
  scene.constant_radiance = Rgb(0.4, 0.5, 0.7);
  // The camera sees its back, which reflects; its front lights what is behind it.
  const Vec3 across = glm::normalize(Vec3(1, 0, -0.3));
  scene.patches.push_back(
      square({0.7, 1.6, 1.2}, across, glm::normalize(Vec3(0, -1, 0.4)), 0.25, {both_sides, of_flipped}));
}

} // namespace

const std::vector<std::string>& emitter_kinds() {
  static const std::vector<std::string> kinds = {"rectangle", "mesh",  "disk", "sphere",      "inside",
                                                 "flipped",   "point", "spot", "directional", "constant"};
  return kinds;
}

scene::Scene room(const std::vector<std::string>& shining) {
  for (const std::string& name : shining)
    if (std::ranges::find(emitter_kinds(), name) == emitter_kinds().end())
      throw std::invalid_argument("no such emitter in the room: " + name);
  const auto on = [&](const char* name) { return std::ranges::find(shining, name) != shining.end(); };
  scene::Scene scene;
  scene.materials = {diffuse({0.7, 0.5, 0.3}), phong({0.2, 0.3, 0.1}, {0.5, 0.4, 0.6}, 20), diffuse(Rgb(0.0)),
                     phong({0.5, 0.2, 0.4}, {0.2, 0.3, 0.3}, 5), brushed_metal()};
  scene.materials[both_sides].two_sided = true;
  add_shapes(scene);
  add_lights(scene);
  // Everything is inside a sphere that emits inwards, if that emitter is on: it would block sun and sky.
  if (on("inside")) scene.spheres.push_back({{0.5, 1, 0}, 9, true, {floor_material, of_inside}});
  const auto off = [&](const char* name, Rgb& power) {
    if (!on(name)) power = Rgb(0.0);
  };
  off("rectangle", scene.area_emitters[of_rectangle].radiance);
  off("mesh", scene.area_emitters[of_mesh].radiance);
  off("disk", scene.area_emitters[of_disk].radiance);
  off("sphere", scene.area_emitters[of_sphere].radiance);
  off("flipped", scene.area_emitters[of_flipped].radiance);
  off("point", scene.point_lights[0].intensity);
  off("spot", scene.spot_lights[0].intensity);
  off("directional", scene.directional_lights[0].irradiance);
  off("constant", *scene.constant_radiance);
  scene.camera = look_at({0.3, 2, 5}, {0, 1, 0}, 45, 16, 16);
  return scene;
}

} // namespace phlux::test
