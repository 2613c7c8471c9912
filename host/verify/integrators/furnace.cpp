#include "verify/integrators/furnace.h"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "lobes/models.h"
#include "measure/sphere_grid.h"
#include "verify/model.h"

namespace phlux::verify {
namespace {

using scene::Vec3;

constexpr int image_side = 8;      // pixels
const Rgb albedo(0.75, 0.5, 0.25); // exact in float32
enum Materials { of_room, of_ball };

const Vec3 ball_centre{0.35, 0.15, -0.2};
constexpr double ball_radius = 0.3;

scene::Camera look_at(const Vec3& from, const Vec3& to, double tan_half_fov) {
  scene::Camera camera;
  camera.position = from;
  camera.forward = glm::normalize(to - from);
  camera.left = glm::normalize(glm::cross(Vec3(0, 1, 0), camera.forward));
  camera.up = glm::cross(camera.forward, camera.left);
  camera.tan_half_fov_x = tan_half_fov;
  camera.width = camera.height = image_side;
  return camera;
}

// A cube of this half side, turned so that no edge is parallel to an axis.
void add_cube(scene::Scene& scene, const Vec3& centre, double half, const scene::Surface& surface) {
  const Vec3 x = glm::normalize(Vec3(2, 1, -1)), y = glm::normalize(glm::cross(Vec3(0, 0, 1), x));
  const std::array<Vec3, 3> axes = {x, y, glm::cross(x, y)};
  for (std::size_t i = 0; i < 3; ++i)
    for (const double side : {-half, half})
      scene.patches.push_back({scene::Patch::Region::parallelogram, centre + side * axes[i],
                               half * axes[(i + 1) % 3], side * axes[(i + 2) % 3], surface});
}

const Rgb ball_diffuse(0.125, 0.25, 0.5), ball_specular(0.75, 0.25, 0.125);
constexpr double ball_exponent = 10;

} // namespace

scene::Scene furnace() {
  scene::Scene scene;
  // The ball's material has the same model with and without a lobe, so that both rooms have one program.
  scene.materials = {lobes::diffuse(albedo), lobes::phong(albedo, Rgb(0), 1)};
  scene.area_emitters = {{Rgb(1)}};
  scene.spheres = {{Vec3(0), 1, true, {of_room, 0}}, {ball_centre, ball_radius, false, {of_ball, 0}}};
  add_cube(scene, {-0.4, -0.25, -0.1}, 0.2, {of_room, 0});
  scene.camera = look_at({0.1, 0.3, 0.75}, {0, -0.05, -0.1}, 0.6);
  return scene;
}

Rgb furnace_radiance(int edges) {
  return glm::pow(albedo, Rgb(edges - 1));
}

Rgb furnace_radiance_up_to(int edges) {
  const Rgb rest = edges < 0 ? Rgb(0) : glm::pow(albedo, Rgb(edges));
  return (1.0 - rest) / (1.0 - albedo);
}

scene::Scene glossy_furnace() {
  scene::Scene scene = furnace();
  scene.materials[of_ball] = lobes::phong(ball_diffuse, ball_specular, ball_exponent);
  // The ball's outline is at tan 0.28, the image's corners at sqrt(2) times this.
  constexpr double tan_half_fov = 0.18;
  scene.camera = look_at({-0.1, 0.45, 0.77}, ball_centre, tan_half_fov);
  return scene;
}

Rgb glossy_furnace_radiance() {
  const scene::Camera camera = glossy_furnace().camera;
  const Vec3 to_ball = ball_centre - camera.position;
  double reflectivity = 0; // of the lobe, mean over the image
  for (const auto& [x, weight_x] : measure::gauss_nodes<10>(-1, 1))
    for (const auto& [y, weight_y] : measure::gauss_nodes<10>(-1, 1)) {
      const Vec3 ray =
          glm::normalize(camera.forward + camera.tan_half_fov_x * (x * camera.left + y * camera.up));
      const double sine = glm::length(glm::cross(ray, to_ball)) / ball_radius; // of the angle at the ball
      reflectivity += weight_x * weight_y / 4 * lobe_reflectivity(ball_exponent, std::asin(sine));
    }
  return 1.0 + (ball_diffuse + ball_specular * reflectivity) * (1.0 + albedo);
}

} // namespace phlux::verify
