#include "scene/digest.h"

#include <functional>

#include <catch2/catch.hpp>

using namespace phlux::scene;

namespace {

Scene one_of_each() {
  Scene scene;
  Model model;
  model.name = "phong";
  model.parameters.resize(2);
  scene.materials.resize(2);
  for (Material& material : scene.materials) {
    material.model = std::make_shared<const Model>(model);
    material.values = {Rgb(0.5), Rgb(30)};
  }
  scene.area_emitters.resize(1);
  scene.patches.resize(1);
  scene.spheres.resize(1);
  scene.meshes = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {{0, 1, 2}}, {}}};
  scene.point_lights.resize(1);
  scene.spot_lights.resize(1);
  scene.directional_lights.resize(1);
  return scene;
}

} // namespace

TEST_CASE("The digest of a scene changes with all that its light depends on") {
  const std::string digest_before = digest(one_of_each());
  CHECK(digest_before.size() == 32);
  CHECK(digest(one_of_each()) == digest_before);
  const std::vector<std::function<void(Scene&)>> changes = {
      [](Scene& s) { s.materials[1].values[0].g = 0.25; },
      [](Scene& s) { s.materials[1].two_sided = true; },
      [](Scene& s) { s.materials[1].opacity.b = 0.5; },
      [](Scene& s) { s.materials[1].opacity_texture = std::make_shared<const Texture>(); },
      [](Scene& s) { s.hide_emitters = true; },
      [](Scene& s) {
        Model other;
        other.name = "velvet";
        s.materials[0].model = std::make_shared<const Model>(other);
      },
      [](Scene& s) {
        Model changed = *s.materials[0].model; // a user's own model, with another text
        changed.text = "static inline";
        s.materials[0].model = std::make_shared<const Model>(changed);
      },
      [](Scene& s) { s.materials.pop_back(); },
      [](Scene& s) { s.area_emitters[0].radiance.r = 2; },
      [](Scene& s) { s.patches[0].edge_v.z = 1; },
      [](Scene& s) { s.patches[0].region = Patch::Region::ellipse; },
      [](Scene& s) { s.patches[0].surface.material = 1; },
      [](Scene& s) { s.spheres[0].radius = 2; },
      [](Scene& s) { s.meshes[0].positions[2].x = 1e-6; },
      [](Scene& s) {
        s.meshes[0].triangles[0] = {0, 2, 1};
      },
      [](Scene& s) { s.meshes[0].normals.resize(3); },
      [](Scene& s) { s.meshes[0].surface.area_emitter = 0; },
      [](Scene& s) { s.point_lights[0].position.y = 1; },
      [](Scene& s) { s.spot_lights[0].beam_width = 0.1; },
      [](Scene& s) { s.directional_lights[0].irradiance.b = 0; },
      [](Scene& s) { s.constant_radiance = Rgb(0); },
      [](Scene& s) { s.environment.emplace(); },
      [](Scene& s) { s.camera.aperture_radius = 1; },
      [](Scene& s) { s.camera.filter.kind = phlux::scene::Filter::Kind::tent; },
      [](Scene& s) {
        s.camera.forward = {1, 0, 0};
      },
      [](Scene& s) { s.camera.principal_y = 0.5; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    CAPTURE(i);
    Scene scene = one_of_each();
    changes[i](scene);
    CHECK(digest(scene) != digest_before);
  }
}

TEST_CASE(
    "The digest of a scene is the same for any image size and method, and for the last digits of numbers") {
  Scene scene = one_of_each();
  scene.camera.width = 3;
  scene.defaults.integrator = "bidir";
  scene.spheres[0].radius += 1e-12;
  scene.patches[0].origin.x = -0.0;
  CHECK(digest(scene) == digest(one_of_each()));
}
