// Interpolated normals: the image of a mesh of a sphere equals that of the sphere.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "images/evidence.h"
#include "images/integrators.h"
#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;
using scene::Vec3;

namespace {

scene::Mesh sphere_mesh(int slices, int stacks) {
  scene::Mesh mesh;
  for (int i = 0; i <= stacks; ++i)
    for (int j = 0; j < slices; ++j) {
      const double theta = std::numbers::pi * i / stacks, phi = 2 * std::numbers::pi * j / slices;
      const Vec3 p(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      mesh.positions.push_back(p);
      mesh.normals.emplace_back(p);
    }
  const auto index = [slices](int i, int j) { return static_cast<std::uint32_t>(i * slices + j % slices); };
  for (int i = 0; i < stacks; ++i)
    for (int j = 0; j < slices; ++j) {
      if (i + 1 < stacks) mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      if (i > 0) mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  return mesh;
}

// Under a sky, from straight ahead: the sphere fills the image.
scene::Scene under_sky(const scene::Material& material) {
  scene::Scene scene;
  scene.materials = {material};
  scene.constant_radiance = scene::Rgb(1.0, 0.5, 2.0);
  scene.camera = look_at({0, 4, 0.3}, {0, 0, 0}, 16, 8, 8);
  return scene;
}

} // namespace

TEST_CASE("a sphere of triangles with vertex normals has the sphere's radiance") {
  for (const scene::Material& material :
       {diffuse({0.8, 0.5, 0.2}), phong({0.3, 0.1, 0.0}, {0.6, 0.2, 0.9}, 50)}) {
    scene::Scene round = under_sky(material), faceted = under_sky(material);
    round.spheres = {{{0, 0, 0}, 1, false, {}}};
    faceted.meshes = {sphere_mesh(96, 48)};
    const Render truth = render_of(round, settings_for(4096)), image = render_of(faceted, settings_for(2048));
    CHECK(image.statistics.nonfinite == 0);
    CHECK(image.statistics.traversal == "bvh");
    // Triangles of size 1/15 lose directions above the horizon of the interpolated normal and below their
    // own: up to a 60th of the projected hemisphere. A ray from the eye hits them up to 1e-3 further away.
    check_agreement(estimate_of(image.film), estimate_of(truth.film), 0.02);
  }
}

TEST_CASE("under the sun a coarse mesh is shaded as smoothly as the sphere") {
  scene::Scene round = under_sky(diffuse({0.8, 0.5, 0.2})), coarse = round;
  for (scene::Scene* scene : {&round, &coarse}) {
    scene->constant_radiance.reset();
    scene->directional_lights = {{glm::normalize(Vec3(1, -1, -0.3)), scene::Rgb(1.0)}};
  }
  round.spheres = {{{0, 0, 0}, 1, false, {}}};
  coarse.meshes = {sphere_mesh(24, 12)};
  // Edges of length 0.26 lie up to 0.01 below the sphere; the normals of a triangle differ by 15 degrees.
  check_agreement(estimate_of(render_of(coarse, settings_for(64)).film),
                  estimate_of(render_of(round, settings_for(64)).film), 0.03);
}

namespace {

// A square in the plane z = 0, front towards +z, with normals tilted by 60 degrees from z towards x.
scene::Mesh tilted_square(double half) {
  const Vec3 normal(std::sin(std::numbers::pi / 3), 0, std::cos(std::numbers::pi / 3));
  scene::Mesh mesh;
  for (const auto& [x, y] :
       {std::pair(-half, -half), std::pair(half, -half), std::pair(half, half), std::pair(-half, half)})
    mesh.positions.emplace_back(x, y, 0);
  mesh.normals.assign(4, glm::vec3(normal));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

struct TiltedCase {
  double seen_from, lit_from; // degrees from +z towards x
  bool two_sided;
  double cosine, strict_cosine; // of the light to the interpolated normal, 0 where it does not count
};

// The square as the camera and a distant light see it; one of half side 9 fills the image.
scene::Scene tilted(const TiltedCase& c, double half) {
  const auto towards = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return Vec3(std::sin(angle), 0, std::cos(angle));
  };
  scene::Scene scene;
  scene.materials = {diffuse({0.8, 0.5, 0.2})};
  scene.materials[0].two_sided = c.two_sided;
  scene.meshes = {tilted_square(half)};
  scene.directional_lights = {{-towards(c.lit_from), scene::Rgb(2.0)}};
  scene.camera = look_at(5.0 * towards(c.seen_from), {0, 0, 0}, 10, 4, 4);
  return scene;
}

} // namespace

// Mitsuba's rule: with strictNormals, directions must lie on the same side of both normals; otherwise, on the
// same side of the interpolated normal.
TEST_CASE("strictNormals: radiance where the interpolated and the geometric normal disagree on a side") {
  const auto cosine = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180); };
  const std::vector<TiltedCase> cases = {
      {20, 40, false, cosine(20), cosine(20)},
      {20, 110, false, cosine(50), 0},  // the light is behind the surface
      {110, 40, false, cosine(20), 0},  // the camera is behind the surface and sees its front
      {-60, -40, false, 0, 0},          // before the surface, on the back of the interpolated normal
      {-60, -40, true, cosine(80), 0},  // the same, and the back reflects
      {-60, -100, true, cosine(20), 0}, // the light is behind the surface in addition
      {-120, -110, true, cosine(10), cosine(10)}, // both behind by both normals
  };
  for (const TiltedCase& c : cases) {
    CAPTURE(c.seen_from, c.lit_from, c.two_sided);
    for (const bool strict : {false, true}) {
      CAPTURE(strict);
      scene::Scene scene = tilted(c, 9);
      scene.strict_normals = strict;
      const double irradiance = 2.0 * (strict ? c.strict_cosine : c.cosine) / std::numbers::pi;
      const Render image = render_of(scene, settings_for(path, 4, 2));
      check_agreement(estimate_of(image.film),
                      uniform(image.film, {0.8 * irradiance, 0.5 * irradiance, 0.2 * irradiance}));
    }
    if (c.cosine != c.strict_cosine)
      check_against_path(tilted(c, 0.3), {light, bidir}, settings_for(16, 2), 4);
  }
}

TEST_CASE("a coarse smooth mesh: light and bidir agree with path") {
  scene::Scene scene;
  scene.materials = {diffuse({0.8, 0.5, 0.2}), phong({0.3, 0.1, 0.0}, {0.6, 0.2, 0.9}, 8)};
  scene.materials[0].two_sided = scene.materials[1].two_sided = true;
  scene.meshes = {sphere_mesh(5, 3), sphere_mesh(4, 3)};
  for (Vec3& p : scene.meshes[1].positions) p = 0.6 * p + Vec3(1.3, 0.4, 0.2);
  scene.meshes[1].surface = {1, -1};
  scene.area_emitters = {{scene::Rgb(3.0)}};
  scene.patches = {square({0, 0, -1.1}, {1, 0, 0}, {0, 1, 0}, 3, {0, -1}),
                   square({0, 0, 3}, {1, 0, 0}, {0, -1, 0}, 0.8, {0, 0})};
  scene.constant_radiance = scene::Rgb(0.3, 0.2, 0.1);
  scene.camera = look_at({0.5, 4, 1.5}, {0.5, 0, 0}, 40, 8, 8);
  check_against_path(scene, {path_hits, light, bidir, bidir_power, bidir_uniform}, settings_for(512, 6), 2);
}
