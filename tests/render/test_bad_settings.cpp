// Settings and scenes that cannot be rendered are refused with UsageError or SceneError, according to the
// cause.
#include <catch2/catch.hpp>

#include "errors.h"
#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;
using Catch::Contains;
using render::Connect;

TEST_CASE("settings that cannot work are wrong usage") {
  const scene::Scene scene = shipped("cornell-box", 4, 4);
  const auto refused = [&](render::Settings with, const std::string& saying) {
    CAPTURE(saying);
    CHECK_THROWS_AS(render_of(scene, with), UsageError);
    CHECK_THROWS_WITH(render_of(scene, with), Contains(saying));
  };
  render::Settings with = settings_for(1);
  with.strategy = "guess";
  refused(with, "guess");
  with = settings_for(1);
  with.integrator = "photons";
  refused(with, "photons");
  refused(settings_for(0), "samples");
  with = settings_for(1);
  with.devices = {"no such device"};
  CHECK_THROWS_AS(render_of(scene, with), DeviceError);
  with = settings_for(1);
  with.kernel_dir = "/nowhere";
  CHECK_THROWS_AS(render_of(scene, with), DeviceError);
}

TEST_CASE("hits alone are refused where no path can hit a light") {
  render::Settings with = settings_for(1);
  with.connect = Connect::none;
  CHECK_THROWS_AS(render_of(shipped("point-light", 4, 4), with), UsageError);
  CHECK_THROWS_WITH(render_of(shipped("point-light", 4, 4), with), Contains("`connect` light or mis"));
}

TEST_CASE("a scene without shapes is a bad scene, one without light is black") {
  scene::Scene scene;
  scene.materials = {diffuse({0.5, 0.5, 0.5})};
  scene.camera = look_at({0, 0, 3}, {0, 0, 0}, 60, 4, 4);
  scene.constant_radiance = scene::Rgb(1.0);
  CHECK_THROWS_AS(render_of(scene, settings_for(1)), SceneError);

  scene.constant_radiance.reset();
  scene.patches = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1e-30, {})};
  CHECK_THROWS_AS(render_of(scene, settings_for(1)), SceneError);

  scene.patches = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, {})};
  for (const Connect connect : {Connect::none, Connect::mis}) {
    render::Settings with = settings_for(4);
    with.connect = connect;
    const Render dark = render_of(scene, with);
    for (const film::Pixel& pixel : dark.film.pixels()) CHECK(pixel.sum == Channels{});
  }
}
