// The furnaces of test_furnaces.cpp for light tracing and bidirectional path tracing.
#include <cmath>

#include <catch2/catch.hpp>

#include "images/evidence.h"
#include "images/furnaces.h"
#include "images/integrators.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;
using scene::Vec3;

namespace {

const Rgb kd(0.3, 0.1, 0.0), ks(0.6, 0.2, 0.9);

void check_sphere(const Method& method, double exponent, const std::string& strategy, int samples) {
  CAPTURE(name_of(method), exponent, strategy);
  const scene::Material material = test::phong(kd, ks, exponent);
  const scene::Scene scene = sphere_furnace(18, 6, material);
  render::Settings settings = settings_for(method, samples);
  settings.strategy = strategy;
  const Render sphere = render_of(scene, settings);
  CHECK(sphere.statistics.nonfinite == 0);
  // 8 x 8 points a pixel are within 1e-4 of the mean of a lobe's reflectivity.
  check_agreement(estimate_of(sphere.film), sphere_reference(scene, material), 1e-4);
}

} // namespace

TEST_CASE("furnace box by light and bidir: 2 at every pixel") {
  const scene::Scene scene = shipped("furnace-box", 8, 8);
  for (const Method& method : {light, bidir, bidir_power}) {
    CAPTURE(name_of(method));
    const Render box = render_of(scene, settings_for(method, 2048));
    check_agreement(estimate_of(box.film), uniform(box.film, {2, 2, 2}));
  }
}

TEST_CASE("furnace box by light and bidir: every depth cuts the series where it says") {
  const scene::Scene scene = shipped("furnace-box", 8, 8);
  for (int depth = 1; depth <= 5; ++depth) {
    const double sum = 2 - std::pow(0.5, depth - 1);
    for (const int rr_depth : {5, 1})
      for (const Method& method : {light, bidir}) {
        CAPTURE(depth, rr_depth, name_of(method));
        render::Settings settings = settings_for(method, 512, depth);
        settings.rr_depth = rr_depth;
        const Render box = render_of(scene, settings);
        check_agreement(estimate_of(box.film), uniform(box.film, {sum, sum, sum}));
      }
  }
}

TEST_CASE("furnace sphere by light and bidir, for exponents as far as each converges") {
  // One in n connections to the eye falls into a lobe of exponent n.
  for (const double exponent : {0.0, 10.0, 50.0}) check_sphere(light, exponent, "exact", 8192);
  for (const double exponent : {0.0, 10.0, 50.0, 1000.0, 1e5}) check_sphere(bidir, exponent, "exact", 2048);
  for (const double exponent : {0.0, 10.0, 50.0}) check_sphere(bidir_power, exponent, "exact", 2048);
}

// The weights of bidir use the densities of both directions, which differ for the exact sampler, and maybe
// not for others.
TEST_CASE("furnace sphere by bidir: strategies of every family") {
  for (const char* strategy : {"cosine", "lobe-ks", "lobe-estimate", "mixture", "fold"})
    check_sphere(bidir, 20, strategy, 2048);
}

TEST_CASE("furnace sphere by light and bidir: every strategy", "[.long]") {
  for (const std::string& strategy : render::strategy_names())
    for (const double exponent : {0.0, 10.0, 50.0})
      if (strategy != "lobe-estimate-printed")
        for (const Method& method : {light, bidir, bidir_power, bidir_uniform})
          check_sphere(method, exponent, strategy, 8192);
}

TEST_CASE("inside a sphere that is turned inwards, and emits, light and bidir find a furnace") {
  scene::Scene scene;
  scene.materials = {diffuse({0.2, 0.4, 0})};
  scene.area_emitters = {{Rgb(1.0)}};
  scene.spheres = {{{1, 2, 3}, 2, true, {0, 0}}};
  scene.camera = look_at({1.5, 2.5, 2}, {0, 2, 3}, 90, 8, 8);
  for (const Method& method : {light, bidir, bidir_power, bidir_uniform}) {
    CAPTURE(name_of(method));
    const Render inside = render_of(scene, settings_for(method, 2048));
    check_agreement(estimate_of(inside.film), uniform(inside.film, {1 / 0.8, 1 / 0.6, 1}));
  }
}

TEST_CASE("a ground that is a sphere of radius 10,000 has no spots by light and bidir") {
  scene::Scene scene;
  scene.materials = {diffuse({0.8, 0.5, 0.2})};
  scene.spheres = {{{3, 7, -1e4}, 1e4, false, {}}};
  scene.point_lights = {{{3, 7, 1.5}, Rgb(10, 20, 30)}};
  scene.camera = look_at({3, 7, 2}, {3.1, 7.2, 0}, 60, 8, 8);
  check_against_path(scene, {light, bidir}, settings_for(128));
}
