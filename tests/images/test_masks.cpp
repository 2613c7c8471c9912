// Masks and hidden emitters by path, light and bidirectional path tracing, against closed forms and each
// other.
#include <cmath>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "images/evidence.h"
#include "images/integrators.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;
using scene::Vec3;

namespace {

scene::Material masked(scene::Material material, const Rgb& opacity) {
  material.two_sided = true;
  material.opacity = opacity;
  return material;
}

scene::Material masked_by_squares(scene::Material material, const Rgb& first, const Rgb& second) {
  scene::Texture squares;
  squares.colors = {first, second};
  squares.to_uv = {3, 0, .2, 0, 2, 0};
  material.two_sided = true;
  material.set_opacity(std::make_shared<const scene::Texture>(squares));
  return material;
}

// A box of masks with a ball in it, all white, in a white sky.
scene::Scene white_box() {
  scene::Scene scene;
  scene.materials = {masked(diffuse(Rgb(1)), Rgb(0.5)), masked(lobes::mirror(Rgb(1)), Rgb(0.6)),
                     masked_by_squares(diffuse(Rgb(1)), Rgb(0.2), Rgb(0.9))};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3 center(0.0), u(0.0), v(0.0);
      center[axis] = side;
      u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
      scene.patches.push_back(square(center, u, v, 1, {axis == 2 ? 2 : 0, -1}));
    }
  scene.spheres = {{{0.3, 0.2, -0.3}, 0.4, false, {1, -1}}};
  scene.constant_radiance = Rgb(1);
  scene.camera = look_at({-0.5, 0.1, 0.6}, {0.1, 0, -0.5}, 70, 4, 4);
  return scene;
}

// A floor that the camera looks down on, and masks between it and the lights, and before the camera.
scene::Scene masked_room(bool hierarchy) {
  scene::Scene scene;
  const scene::Material diffuse_floor = diffuse({0.7, 0.5, 0.6});
  scene.materials = {diffuse_floor, masked(diffuse({0.6, 0.8, 0.4}), {0.3, 0.5, 0.8}),
                     masked_by_squares(test::phong(Rgb(0.3), Rgb(0.4), 10), Rgb(0), Rgb(1, 0.9, 0.7)),
                     masked(diffuse(Rgb(0.0)), Rgb(0.4))};
  scene.patches = {square({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 2, {0, -1}),
                   square({0, 0.9, 0}, {0, 0, 1}, {1, 0, 0}, 1.2, {2, -1}),
                   square({0.2, 2.5, 0.3}, {1, 0, 0}, {0, 0, 1}, 0.4, {3, -1}),
                   square({1.5, 0.6, 0}, {0, 0, 1}, {0, 1, 0}, 0.5, {0, 0})};
  scene.spheres = {{{-0.6, 0.4, 0.1}, 0.3, false, {1, -1}}, {{0.4, 2, 0.2}, 0.2, false, {0, 1}}};
  scene.meshes = {smooth_ball({0.5, 0.5, 0.3}, 0.3, hierarchy ? 2 : 1)};
  scene.area_emitters = {{Rgb(4, 3, 2)}, {Rgb(9, 8, 7)}};
  scene.point_lights = {{{-0.8, 1.8, 0.6}, Rgb(3, 2, 1)}};
  scene.directional_lights = {{glm::normalize(Vec3(-0.2, -1, 0.1)), Rgb(0.3, 0.4, 0.5)}};
  scene.constant_radiance = Rgb(0.2, 0.1, 0.15);
  scene.camera = look_at({0.2, 3, 0.3}, {0.1, 0, 0.2}, 40, 8, 8);
  return scene;
}

} // namespace

TEST_CASE("masks: of a plane under a sky, the part opacity reflects it and the rest lets it pass") {
  const Rgb albedo(0.6, 0.4, 0.2), opacity(0.25, 0.5, 1);
  scene::Scene scene = white_box();
  scene.materials[0] = masked(diffuse(albedo), opacity);
  for (std::size_t i = 1; i < scene.patches.size(); ++i) { // what else there is is small, and white
    scene.patches[i].edge_u *= 1e-3;
    scene.patches[i].edge_v *= 1e-3;
    scene.patches[i].origin = Vec3(0, 0, 9);
  }
  scene.spheres[0] = {{0, 0, 10}, 1e-3, false, {1, -1}};
  scene.patches[0] = square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 100, {0, -1});
  scene.constant_radiance = Rgb(1, 2, 3);
  scene.camera = look_at({0.3, 0, 2}, {2, 0, 0}, 60, 4, 4);
  const Rgb seen = *scene.constant_radiance * (opacity * albedo + (Rgb(1) - opacity));
  for (const Method& method : {path, bidir}) {
    CAPTURE(name_of(method));
    const Render plane = render_of(scene, settings_for(method, 2048));
    check_agreement(estimate_of(plane.film), uniform(plane.film, {seen.r, seen.g, seen.b}), 1e-4);
  }
  scene.materials[0].opacity = Rgb(0); // as if nothing were there
  const Render sky = render_of(scene, settings_for(path, 16));
  check_agreement(estimate_of(sky.film), uniform(sky.film, {1, 2, 3}), 1e-5);
}

// Roulette ends one path of a thousand at each vertex, which few samples of a pixel show: they have another
// mean, by more than their standard error, but not by more than the tolerance.
TEST_CASE("masks: white masks cannot be told from a white sky, with roulette") {
  for (const Method& method : {path, bidir}) {
    CAPTURE(name_of(method));
    render::Settings with = settings_for(method, 4096);
    with.rr_depth = 1;
    const Render box = render_of(white_box(), with);
    CHECK(box.statistics.nonfinite == 0);
    check_agreement(estimate_of(box.film), uniform(box.film, {1, 1, 1}), 5e-3);
  }
}

TEST_CASE("masks: lights of every kind are seen through them alike by path, light and bidir") {
  for (const bool hierarchy : {false, true}) {
    CAPTURE(hierarchy);
    render::Settings with = settings_for(128);
    with.traversal = hierarchy ? render::Traversal::bvh : render::Traversal::brute_force;
    const std::vector<Method> methods = hierarchy ? std::vector{bidir} : std::vector{light, bidir};
    check_against_path(masked_room(hierarchy), methods, with, 2);
  }
}

TEST_CASE("masks: a point light is the darker by each mask before it") {
  scene::Scene scene;
  scene.materials = {diffuse(Rgb(0.5)), masked(diffuse(Rgb(0)), Rgb(0.2, 0.5, 0.9)),
                     masked(diffuse(Rgb(0)), Rgb(0.5))};
  scene.patches = {square({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 2, {0, -1}),
                   square({0, 2, 0}, {0, 0, 1}, {1, 0, 0}, 2, {1, -1}),
                   square({0, 2.1, 0}, {0, 0, 1}, {1, 0, 0}, 2, {2, -1})};
  scene.point_lights = {{{0, 3, 0}, Rgb(10)}};
  scene.camera = look_at({0, 1.5, 0}, {0, 0, 0.01}, 30, 4, 4);
  const Rgb passing = Rgb(0.8, 0.5, 0.1) * 0.5;
  scene::Scene bare = scene;
  bare.materials[1].opacity = bare.materials[2].opacity = Rgb(0);
  for (const Method& method : {path, light}) {
    CAPTURE(name_of(method));
    const Render dim = render_of(scene, settings_for(method, 4096)),
                 bright = render_of(bare, settings_for(path, 4096));
    Estimate expected = estimate_of(bright.film);
    for (std::size_t i = 0; i < expected.mean.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        expected.mean[i][channel] *= passing[c];
        expected.variance[i][channel] *= passing[c] * passing[c];
      }
    check_agreement(estimate_of(dim.film), expected, 1e-4);
  }
}

TEST_CASE("hidden emitters: the camera sees their surfaces, and what they light, but not their light") {
  scene::Scene scene = masked_room(false);
  scene.camera = look_at({0.2, 1.2, 2.5}, {0.3, 1.2, 0}, 60, 8, 8);
  const Repeated shown = repeated(scene, path, settings_for(64));
  scene.hide_emitters = true;
  const Repeated hidden = repeated(scene, path, settings_for(64));
  int darker = 0;
  for (std::size_t i = 0; i < hidden.image.mean.size(); ++i)
    darker += hidden.image.mean[i][0] < 0.7 * shown.image.mean[i][0] ? 1 : 0;
  CHECK(darker > 8); // the lamps and the sky
  CHECK(hidden.mean.mean[0][0] > 0);
  // What is left out is what the camera sees with one edge.
  scene.hide_emitters = false;
  const Repeated seen = repeated(scene, path, settings_for(64, 1));
  for (std::size_t i = 0; i < hidden.image.mean.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      CHECK(hidden.image.mean[i][c] + seen.image.mean[i][c] ==
            Approx(shown.image.mean[i][c]).epsilon(1e-4).margin(1e-5));
  scene.hide_emitters = true;
  check_against_path(scene, {light, bidir}, settings_for(512), 2);
}
