// Interpolated normals: the image of a mesh of a sphere equals that of the sphere.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "images/evidence.h"
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
