// The thin lens, the orthographic camera and reconstruction filters by path, light and bidirectional path
// tracing: against quadrature, and against each other.
#include <cmath>
#include <functional>
#include <numbers>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "images/evidence.h"
#include "images/integrators.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;
using scene::Vec3;
using Kind = scene::Filter::Kind;

namespace {

constexpr double pi = std::numbers::pi, albedo = 0.6;
const Rgb intensity(0.5, 1, 2);
const Vec3 lamp(0.1, 0.4, -0.1);

// A floor, a point light close above it, a sphere that emits, and a sky. All but the point light are dark,
// and the sphere is out of the way, unless `all`.
scene::Scene studio(const scene::Camera& camera, bool all) {
  scene::Scene scene;
  scene.materials = {diffuse(Rgb(albedo))};
  scene.patches = {square({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, all ? 1.2 : 4, {0, -1})};
  scene.area_emitters = {{Rgb(all ? 3.0 : 0.0)}};
  scene.spheres = {{all ? Vec3(-0.4, 0.5, 0.3) : Vec3(0, -3, 0), 0.2, false, {0, 0}}};
  scene.point_lights = {{lamp, intensity}};
  scene.constant_radiance = Rgb(all ? 0.5 : 0.0);
  scene.camera = camera;
  return scene;
}

scene::Camera parallel() {
  scene::Camera camera = look_at({0.3, 2, 1}, {0, 0, 0}, 1, 6, 5);
  camera.orthographic = true;
  camera.tan_half_fov_x = 1.1;
  camera.filter = {Kind::tent, 1.3};
  return camera;
}

scene::Camera lens() {
  scene::Camera camera = look_at({0.3, 2, 1}, {0, 0, 0}, 40, 6, 5);
  camera.aperture_radius = 0.3;
  camera.focus_distance = 0.8;
  camera.filter = {Kind::gaussian, 0.6};
  return camera;
}

struct Line {
  Vec3 origin, direction;
};

// The ray through (x, y) in pixels from the upper left corner and a point of the unit disk of the lens.
Line ray_of(const scene::Camera& camera, double x, double y, double a, double b) {
  const double half = camera.tan_half_fov_x, aspect = static_cast<double>(camera.height) / camera.width;
  const Vec3 across = (1 - 2 * x / camera.width) * half * camera.left +
                      (1 - 2 * y / camera.height) * half * aspect * camera.up;
  if (camera.orthographic) return {camera.position + across, camera.forward};
  const Vec3 in_focus = camera.position + camera.focus_distance * (camera.forward + across);
  const Vec3 from = camera.position + camera.aperture_radius * (a * camera.left + b * camera.up);
  return {from, in_focus - from};
}

double filter_at(const scene::Filter& filter, double offset) {
  if (filter.kind == Kind::tent) return std::max(0.0, 1 - std::abs(offset) / filter.size);
  return std::exp(-0.5 * offset * offset / (filter.size * filter.size));
}

// Mean of f over the unit disk, by the midpoint rule in the squared radius and the angle.
double mean_over_disk(int points, const std::function<double(double, double)>& f) {
  double sum = 0;
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      const double radius = std::sqrt((i + 0.5) / points), angle = 2 * pi * (j + 0.5) / points;
      sum += f(radius * std::cos(angle), radius * std::sin(angle));
    }
  return sum / (points * points);
}

double radiance_of_floor(const Line& ray) {
  const Vec3 at = ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
  const Vec3 way = lamp - at;
  return albedo / pi * way.y / std::pow(glm::dot(way, way), 1.5);
}

// The floor under the point light of intensity 1, by quadrature over filter and lens.
Estimate filtered(const scene::Camera& camera) {
  constexpr int points = 40;
  const double reach = camera.filter.kind == Kind::tent ? camera.filter.size : 5 * camera.filter.size;
  std::vector<Channels> means;
  for (int pixel = 0; pixel < camera.width * camera.height; ++pixel) {
    double sum = 0, weights = 0;
    for (int i = 0; i < points * points; ++i) {
      const double dx = reach * ((i % points * 2 + 1.0) / points - 1);
      const double dy = reach * ((i / points * 2 + 1.0) / points - 1);
      const double weight = filter_at(camera.filter, dx) * filter_at(camera.filter, dy);
      const double x = pixel % camera.width + 0.5 + dx, y = pixel / camera.width + 0.5 + dy;
      sum += weight * mean_over_disk(camera.orthographic ? 1 : 10, [&](double a, double b) {
               return radiance_of_floor(ray_of(camera, x, y, a, b));
             });
      weights += weight;
    }
    const Rgb seen = sum / weights * intensity;
    means.push_back({seen.r, seen.g, seen.b});
  }
  return closed_form(camera.width, camera.height, std::move(means));
}

void check_camera(const scene::Camera& camera) {
  const Estimate reference = filtered(camera);
  for (const Method& method : {path, light, bidir}) {
    CAPTURE(name_of(method));
    const Render floor = render_of(studio(camera, false), settings_for(method, 8192));
    CHECK(floor.statistics.nonfinite == 0);
    check_agreement(estimate_of(floor.film), reference, 1e-3);
  }
  check_against_path(studio(camera, true), {light, bidir}, settings_for(256), 2);
}

} // namespace

TEST_CASE("cameras: an orthographic camera with a tent filter") {
  check_camera(parallel());
}

TEST_CASE("cameras: a thin lens with a Gaussian filter") {
  check_camera(lens());
}

TEST_CASE("cameras: light tracing sees the sky through all of the pixels of an orthographic camera") {
  scene::Scene scene;
  scene.materials = {diffuse(Rgb(0))};
  scene.patches = {square({0.5, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.25, {0, -1})}; // a sixteenth of the pixel
  scene.constant_radiance = Rgb(1);
  scene.camera = look_at({0, 0, 5}, {0, 0, 0}, 1, 1, 1);
  scene.camera.orthographic = true;
  scene.camera.tan_half_fov_x = 1;
  for (const Method& method : {path, light, bidir}) {
    CAPTURE(name_of(method));
    const Render seen = render_of(scene, settings_for(method, 20000));
    check_agreement(estimate_of(seen.film), uniform(seen.film, {0.9375, 0.9375, 0.9375}));
  }
}

// The pixels must be random ones: those of the paths in turn would make the error of whole blocks 0, far less
// than its estimate, and give a launch that ends within a block too many or too few of them.
TEST_CASE("cameras: the error of the sky that light tracing sees by an orthographic camera is as estimated") {
  scene::Scene scene;
  scene.materials = {diffuse(Rgb(0))};
  scene.patches = {square({50, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.25, {0, -1})}; // out of view
  scene.constant_radiance = Rgb(1);
  scene.camera = look_at({0, 0, 5}, {0, 0, 0}, 1, 32, 24);
  scene.camera.orthographic = true;
  scene.camera.tan_half_fov_x = 1;
  const Render seen = render_of(scene, settings_for(light, 256));
  const std::size_t pixels = seen.film.pixels().size();
  double squares = 0.0; // of the deviations in standard errors
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    const double deviation = seen.film.mean(pixel, 0) - 1.0;
    squares += deviation * deviation / seen.film.variance_of_mean(pixel, 0);
  }
  // Mean of 768 values with a variance of 2 each; false alarms: 1e-5.
  CHECK(squares / static_cast<double>(pixels) ==
        Approx(1.0).margin(4.4 * std::sqrt(2.0 / static_cast<double>(pixels))));
}
