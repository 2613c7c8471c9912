// Area lights over a plane: irradiance in closed form, from the form factors of disk, sphere and polygon.
#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "images/evidence.h"
#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;
using render::Connect;
using scene::Rgb;
using scene::Vec3;

namespace {

constexpr double pi = std::numbers::pi;
const Vec3 eye(0.05, -0.1, 1);
const Rgb albedo(0.8, 0.5, 0.2), radiance(3, 2, 1);

// Material 0: the plane's, 1: black, for lights.
scene::Scene plane() {
  scene::Scene scene;
  scene.materials = {diffuse(albedo), diffuse(Rgb(0.0))};
  scene.area_emitters = {{radiance}};
  scene.patches = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, {})};
  scene.camera = look_at(eye, eye - Vec3(0, 0, 1), 60, 8, 8);
  return scene;
}
constexpr scene::Surface light{1, 0};

// Form factors from a point of the plane z = 0, facing up: irradiance / (pi radiance).

// A disk about `center`, parallel to the plane (Howell's catalogue of configuration factors, B-13).
double of_disk(const Vec3& point, const Vec3& center, double radius) {
  const double h2 = (center.z - point.z) * (center.z - point.z);
  const double dx = center.x - point.x, dy = center.y - point.y, a2 = dx * dx + dy * dy, r2 = radius * radius;
  const double sum = h2 + a2 + r2;
  return 0.5 * (1 - (h2 + a2 - r2) / std::sqrt(sum * sum - 4 * r2 * a2));
}

// A sphere wholly above the plane.
double of_sphere(const Vec3& point, const Vec3& center, double radius) {
  const Vec3 way = center - point;
  const double distance = glm::length(way);
  return radius * radius / (distance * distance) * way.z / distance;
}

// A polygon above the plane (Lambert 1760); the corners' order decides the sign.
double of_polygon(const Vec3& point, const std::vector<Vec3>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = glm::normalize(corners[i] - point);
    const Vec3 b = glm::normalize(corners[(i + 1) % corners.size()] - point);
    const Vec3 normal = glm::cross(a, b);
    sum += std::atan2(glm::length(normal), glm::dot(a, b)) * normal.z / glm::length(normal);
  }
  return std::abs(sum) / (2 * pi);
}

template<class FormFactor>
Estimate lit(const scene::Scene& scene, FormFactor form_factor) {
  return expected(scene.camera, [&](const Vec3& direction) {
    const Rgb result = albedo * radiance * form_factor(eye - eye.z / direction.z * direction);
    return Channels{result.r, result.g, result.b};
  });
}

void check_all_ways(const scene::Scene& scene, const std::vector<Connect>& ways, const Estimate& reference,
                    int samples = 1024) {
  for (const Connect connect : ways) {
    CAPTURE(static_cast<int>(connect));
    render::Settings with = settings_for(samples, 2);
    with.connect = connect;
    check_agreement(estimate_of(render_of(scene, with).film), reference);
  }
}

const Vec3 disk_center(0.2, 0.1, 1.5), sphere_center(-0.3, 0.4, 2);
constexpr double disk_radius = 0.8, sphere_radius = 0.7;

scene::Patch disk_facing(const Vec3& front) {
  const Vec3 edge_u(disk_radius, 0, 0);
  return {scene::Patch::Region::ellipse, disk_center, edge_u, glm::cross(front, edge_u), light};
}

} // namespace

TEST_CASE("a disk light parallel to the plane") {
  scene::Scene scene = plane();
  scene.patches.push_back(disk_facing({0, 0, -1}));
  check_all_ways(scene, {Connect::none, Connect::light, Connect::mis},
                 lit(scene, [](const Vec3& p) { return of_disk(p, disk_center, disk_radius); }), 8192);
  // Straight below its middle: pi L r^2 / (r^2 + h^2).
  CHECK(of_disk({0.2, 0.1, 0}, disk_center, disk_radius) == Approx(0.64 / (0.64 + 2.25)));
}

TEST_CASE("a sphere light") {
  scene::Scene scene = plane();
  scene.spheres = {{sphere_center, sphere_radius, false, light}};
  check_all_ways(scene, {Connect::none, Connect::light, Connect::mis},
                 lit(scene, [](const Vec3& p) { return of_sphere(p, sphere_center, sphere_radius); }));
}

TEST_CASE("a rectangle light that is inclined") {
  scene::Scene scene = plane();
  const Vec3 center(-0.4, 0.2, 1.4), edge_u(0, 0.7, 0), edge_v(0.5, 0, 0.3);
  scene.patches.push_back({scene::Patch::Region::parallelogram, center, edge_u, edge_v, light});
  const std::vector<Vec3> corners = {center - edge_u - edge_v, center + edge_u - edge_v,
                                     center + edge_u + edge_v, center - edge_u + edge_v};
  check_all_ways(scene, {Connect::light, Connect::mis},
                 lit(scene, [&](const Vec3& p) { return of_polygon(p, corners); }));
}

TEST_CASE("a constant sky over a plane") {
  scene::Scene scene = plane();
  scene.constant_radiance = radiance;
  scene.area_emitters.clear();
  check_all_ways(scene, {Connect::light, Connect::mis}, lit(scene, [](const Vec3&) { return 1.0; }));
}

// Each kind has a different colour, so that mistaking one for another changes the image. Lights hide the sky,
// so each adds its radiance minus that of the sky.
TEST_CASE("every kind of light at once") {
  scene::Scene scene = plane();
  const Rgb sky(0.1, 0.2, 0.3), of_disk_light(6, 1, 0), of_sphere_light(0, 7, 1), of_triangle(2, 0, 9),
      of_rectangle(4, 5, 0);
  scene.area_emitters = {{of_disk_light}, {of_sphere_light}, {of_triangle}, {of_rectangle}};
  scene.constant_radiance = sky;
  const Vec3 disk(2, 0, 2), ball(-2, 0.3, 2), square_center(0, 2.5, 1.5);
  scene.patches.push_back({scene::Patch::Region::ellipse, disk, {0.5, 0, 0}, {0, -0.5, 0}, {1, 0}});
  scene.spheres = {{ball, 0.5, false, {1, 1}}};
  const std::vector<Vec3> triangle = {{-0.5, -2.5, 1.5}, {0, -2, 2}, {0.5, -2.5, 1.5}};
  scene.meshes = {{triangle, {}, {{0, 1, 2}}, {1, 2}}};
  scene.patches.push_back(square(square_center, {0, 1, 0}, {1, 0, 0}, 0.4, {1, 3}));
  std::vector<Vec3> rectangle;
  for (const Vec3& corner : {Vec3(-0.4, -0.4, 0), Vec3(0.4, -0.4, 0), Vec3(0.4, 0.4, 0), Vec3(-0.4, 0.4, 0)})
    rectangle.push_back(square_center + corner);
  const Vec3 point_light(0.5, 0.5, 1.2), spot_light(-0.5, 0.3, 1.5),
      sun = glm::normalize(Vec3(0.1, -0.2, -1));
  scene.point_lights = {{point_light, {0, 0, 5}}};
  scene.spot_lights = {{spot_light, {0, 0, -1}, {5, 0, 0}, 1.2, 1.1}};
  scene.directional_lights = {{sun, {0, 0.7, 0}}};

  const auto of_intensity = [](const Vec3& point, const Vec3& from) {
    const Vec3 way = from - point;
    const double distance = glm::length(way);
    return way.z / (distance * distance * distance) / pi;
  };
  const Estimate reference = expected(scene.camera, [&](const Vec3& direction) {
    const Vec3 p = eye - eye.z / direction.z * direction;
    const Rgb sum =
        sky + (of_disk_light - sky) * of_disk(p, disk, 0.5) +
        (of_sphere_light - sky) * of_sphere(p, ball, 0.5) + (of_triangle - sky) * of_polygon(p, triangle) +
        (of_rectangle - sky) * of_polygon(p, rectangle) + Rgb(0, 0, 5 * of_intensity(p, point_light)) +
        Rgb(5 * of_intensity(p, spot_light), 0, 0) + Rgb(0, 0.7 * -sun.z / pi, 0);
    const Rgb result = albedo * sum;
    return Channels{result.r, result.g, result.b};
  });
  // A light may be chosen by one sample in thirty: there are enough for a normal mean.
  check_all_ways(scene, {Connect::light, Connect::mis}, reference, 8192);
  render::Settings with = settings_for(8192, 2);
  with.traversal = render::Traversal::bvh;
  check_agreement(estimate_of(render_of(scene, with).film), reference);
}
