// The same seed gives the same image bit for bit; another seed gives another image.
#include <algorithm>
#include <ranges>

#include <catch2/catch.hpp>

#include "cli/program.h"
#include "images/evidence.h"
#include "images/scenes.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::test;

namespace {

Render cornell_box(std::uint64_t seed, double launch_seconds = 0.05) {
  render::Settings with = settings_for(100); // whole blocks of samples and a partial one
  with.seed = seed;
  with.launch_seconds = launch_seconds;
  return render_of(shipped("cornell-box", 33, 17), with);
}

bool same_bits(const film::Film& a, const film::Film& b) {
  return std::ranges::equal(a.pixels(), b.pixels(), [](const film::Pixel& x, const film::Pixel& y) {
    return x.sum == y.sum && x.sum_of_squares == y.sum_of_squares && x.samples == y.samples;
  });
}

} // namespace

TEST_CASE("the same seed gives the same bits, whatever the length of launches") {
  const Render first = cornell_box(7, 0.002);
  CHECK(same_bits(cornell_box(7, 0.002).film, first.film));
  CHECK(same_bits(cornell_box(7, 0.2).film, first.film));
  for (const film::Pixel& pixel : first.film.pixels()) CHECK(pixel.samples == 100);
}

namespace {

// A lamp of many triangles, whose tree Embree builds in several threads.
Render under_many_lights(double launch_seconds) {
  scene::Scene scene;
  scene.materials = {diffuse(scene::Rgb(0.5)), diffuse(scene::Rgb(0.0))};
  scene.patches = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, {0, -1}),
                   square({0, 2, 1}, {1, 0, 0}, {0, 0, -1}, 2, {0, -1})};
  scene.area_emitters = {{scene::Rgb(3, 2, 1)}};
  constexpr int side = 64;
  scene::Mesh lamp;
  for (int i = 0; i < side * side; ++i) {
    const scene::Vec3 corner(i % side / 16.0 - 2, i / side / 16.0 - 2, 2);
    const auto first = static_cast<std::uint32_t>(lamp.positions.size());
    for (const scene::Vec3& edge : {scene::Vec3(0), scene::Vec3(0, 0.03, 0), scene::Vec3(0.03, 0, 0)})
      lamp.positions.push_back(corner + edge);
    lamp.triangles.push_back({first, first + 1, first + 2});
  }
  lamp.surface = {1, 0};
  scene.meshes.push_back(lamp);
  scene.camera = look_at({0, -2, 1}, {0, 0, 0.3}, 50, 17, 11);
  render::Settings with = settings_for(40);
  with.integrator = "bidir";
  with.launch_seconds = launch_seconds;
  return render_of(scene, with);
}

} // namespace

TEST_CASE("the same seed gives the same bits from a tree of lights and with roulette of connections") {
  const Render first = under_many_lights(0.002);
  CHECK(std::ranges::count(first.statistics.parts, "light_tree") == 1);
  CHECK(same_bits(under_many_lights(0.002).film, first.film));
  CHECK(same_bits(under_many_lights(0.2).film, first.film));
}

TEST_CASE("seeds differ in all of their 64 bits") {
  const Render zero = cornell_box(0);
  for (const std::uint64_t seed :
       {std::uint64_t{1}, std::uint64_t{1} << 31, std::uint64_t{1} << 32, std::uint64_t{1} << 63}) {
    CAPTURE(seed);
    const Render other = cornell_box(seed);
    CHECK_FALSE(same_bits(other.film, zero.film));
    check_agreement(tiles(estimate_of(other.film), 8), tiles(estimate_of(zero.film), 8));
  }
}

TEST_CASE("the number of PoCL's threads does not change a bit") {
  const TemporaryFolder folder;
  for (const char* integrator : {"path", "light", "bidir"}) {
    CAPTURE(integrator);
    const auto render = [&](const std::string& threads, const std::string& image) {
      return run({{"render", PHLUX_SOURCE_DIR "/scenes/cornell-box.xml", "-i", integrator, "--size", "24x24",
                   "-n", "20", "-q", "-o", image},
                  folder.path(),
                  {{"POCL_MAX_PTHREAD_COUNT", threads}},
                  {}});
    };
    REQUIRE(render("1", "one.exr").exit_code == 0);
    REQUIRE(render("3", "three.exr").exit_code == 0);
    const Outcome compared = run({{"compare", "one.exr", "three.exr", "--json"}, folder.path(), {}, {}});
    REQUIRE(compared.exit_code == 0);
    CHECK_THAT(compared.out, Catch::Contains("\"rmse\": 0.0,"));
  }
}
