// When a render ends and when a path ends.
#include <algorithm>

#include <catch2/catch.hpp>

#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;
using render::Connect;

namespace {

bool every_pixel_has_samples(const film::Film& film) {
  return std::ranges::all_of(film.pixels(), [](const film::Pixel& pixel) { return pixel.samples > 0; });
}

} // namespace

TEST_CASE("a limit of time ends the render when two launches more are done, with samples in every pixel") {
  render::Settings with = settings_for(1);
  with.time_limit = 0.3;
  film::Film film(64, 64);
  int launches_after = 0;
  render::Events events;
  events.progress = [&](const render::Progress& progress) {
    launches_after += progress.seconds >= 0.3 ? 1 : 0;
    return true;
  };
  const auto statistics = render::render(shipped("cornell-box", 64, 64), with, film, events);
  CHECK(statistics.seconds_render >= 0.3);
  CHECK(launches_after >= 1);
  CHECK(launches_after <= 2);
  CHECK(every_pixel_has_samples(film));
  CHECK(static_cast<double>(statistics.paths) / 4096 == Approx(film.samples_per_pixel()));
}

TEST_CASE("an error that is asked for is reached") {
  render::Settings with = settings_for(1);
  with.target_error = 0.04;
  with.time_limit = 30; // in case it is not
  const Render image = render_of(shipped("cornell-box", 16, 16), with);
  CHECK(image.film.relative_standard_error() <= 0.04);
  CHECK(image.statistics.seconds_render < 30);
}

TEST_CASE("progress is told, and ends the render when it says so") {
  film::Film film(64, 64);
  int calls = 0;
  double samples = 0;
  render::Events events;
  events.progress = [&](const render::Progress& progress) {
    CHECK(progress.samples_done > samples);
    CHECK(progress.samples_total == 1 << 20);
    samples = progress.samples_done;
    return ++calls < 3;
  };
  const auto statistics = render::render(shipped("cornell-box", 64, 64), settings_for(1 << 20), film, events);
  CHECK(calls == 3);
  CHECK(statistics.paths >= static_cast<std::uint64_t>(samples * 4096));
  CHECK(statistics.paths < 4096ull << 19);
}

TEST_CASE("roulette changes no expectation, whenever it begins") {
  const scene::Scene scene = shipped("cornell-box", 16, 16);
  const auto image = [&](int rr_depth) {
    render::Settings with = settings_for(512);
    with.rr_depth = rr_depth;
    with.seed = static_cast<std::uint64_t>(rr_depth + 10);
    return tiles(estimate_of(render_of(scene, with).film), 2);
  };
  const Estimate never = image(-1);
  for (const int rr_depth : {1, 2, 5}) {
    CAPTURE(rr_depth);
    check_agreement(image(rr_depth), never);
  }
}

TEST_CASE("a path has as many edges as it may, and no more") {
  const scene::Scene scene = shipped("furnace-box", 16, 16);
  for (const int depth : {1, 2, 7}) {
    CAPTURE(depth);
    render::Settings with = settings_for(16, depth);
    with.rr_depth = -1; // without roulette no path of a closed box ends earlier
    const Render image = render_of(scene, with);
    CHECK(image.statistics.paths == 4096);
    CHECK(image.statistics.rays == 4096u * static_cast<unsigned>(depth));
    CHECK(image.statistics.shadow_rays <= 4096u * static_cast<unsigned>(depth - 1));
  }
}

TEST_CASE("a closed room that absorbs nothing ends all the same") {
  scene::Scene scene = shipped("furnace-box", 4, 4);
  for (scene::Material& material : scene.materials) material = diffuse({1, 1, 1});
  const Render image = render_of(scene, settings_for(16));
  CHECK(image.statistics.paths == 256);
  CHECK(image.statistics.nonfinite == 0);
  // Roulette lets a path live with 0.999 at most: 1000 edges on average, 256 paths of them.
  CHECK(image.statistics.rays > 100'000);
  CHECK(image.statistics.rays < 1'000'000);
}
