// Surfaces have a front and a back.
#include <catch2/catch.hpp>

#include "images/evidence.h"
#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;
using render::Connect;
using scene::Rgb;
using scene::Vec3;

namespace {

const Rgb albedo(0.8, 0.5, 0.2);

// A plane that faces +z under a sky, viewed from one side.
scene::Scene plane_seen_from(double z, bool two_sided) {
  scene::Scene scene;
  scene.materials = {diffuse(albedo)};
  scene.materials[0].two_sided = two_sided;
  scene.patches = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 10, {})};
  scene.constant_radiance = Rgb(1.0);
  scene.camera = look_at({0, 0, z}, {0.3, 0.1, 0}, 40, 8, 8);
  return scene;
}

// A light over the surface or in it, facing towards it or away.
scene::Scene over_plane() {
  scene::Scene scene;
  scene.materials = {diffuse(albedo), diffuse(Rgb(0.0))};
  scene.patches = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 10, {})};
  scene.area_emitters = {{Rgb(5.0)}};
  scene.camera = look_at({0, 0, 1}, {0.1, 0, 0}, 60, 8, 8);
  return scene;
}
constexpr scene::Surface light{1, 0};

} // namespace

TEST_CASE("a surface is black from behind, unless it is two-sided") {
  const Render front = render_of(plane_seen_from(1, false), settings_for(64));
  check_agreement(estimate_of(front.film), uniform(front.film, {0.8, 0.5, 0.2}));
  CHECK(is_black(render_of(plane_seen_from(-1, false), settings_for(64)).film));
  for (const double z : {1.0, -1.0}) {
    const Render either = render_of(plane_seen_from(z, true), settings_for(64));
    check_agreement(estimate_of(either.film), uniform(either.film, {0.8, 0.5, 0.2}));
  }
}

TEST_CASE("a light that faces away lights nothing") {
  for (const Connect connect : {Connect::none, Connect::mis}) {
    CAPTURE(static_cast<int>(connect));
    render::Settings with = settings_for(128);
    with.connect = connect;
    const auto lit_by = [&](const scene::Patch& patch) {
      scene::Scene scene = over_plane();
      scene.patches.push_back(patch);
      return render_of(scene, with);
    };
    const auto ellipse = scene::Patch::Region::ellipse;
    CHECK(is_black(lit_by(square({0, 0, 2}, {1, 0, 0}, {0, 1, 0}, 1, light)).film));
    CHECK_FALSE(is_black(lit_by(square({0, 0, 2}, {0, 1, 0}, {1, 0, 0}, 1, light)).film));
    if (connect == Connect::mis) {
      CHECK(is_black(lit_by({ellipse, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, light}).film));
      CHECK_FALSE(is_black(lit_by({ellipse, {0, 0, 2}, {0, 1, 0}, {1, 0, 0}, light}).film));
      scene::Scene scene = over_plane();
      scene.spheres = {{{0, 0, 3}, 1, true, light}};
      CHECK(is_black(render_of(scene, with).film));
    }
  }
}

TEST_CASE("inside a sphere that is turned inwards, and emits, it is a furnace") {
  scene::Scene scene;
  scene.materials = {phong({0.2, 0.4, 0}, {0.0, 0.0, 0.0}, 0)};
  scene.area_emitters = {{Rgb(1.0)}};
  scene.spheres = {{{1, 2, 3}, 2, true, {0, 0}}};
  scene.camera = look_at({1.5, 2.5, 2}, {0, 2, 3}, 90, 8, 8);
  for (const Connect connect : {Connect::none, Connect::light, Connect::mis}) {
    CAPTURE(static_cast<int>(connect));
    render::Settings with = settings_for(512);
    with.connect = connect;
    with.roulette =
        render::Roulette::reflectivity; // few paths survive `efficiency` here: sums would not be normal
    const Render inside = render_of(scene, with);
    check_agreement(estimate_of(inside.film), uniform(inside.film, {1 / 0.8, 1 / 0.6, 1}));
  }
  SECTION("not turned, it is black from inside") {
    scene.spheres[0].front_is_inside = false;
    CHECK(is_black(render_of(scene, settings_for(64)).film));
  }
}
