// Conditions that end a render.
#include <algorithm>
#include <tuple>

#include <catch2/catch.hpp>

#include "film/reliability.h"
#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;

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

// Small images are rendered faster than the error can be watched.
TEST_CASE("the requested error is reached, and not more than that") {
  for (const auto& [side, error, integrator] :
       {std::tuple{8, 0.02, "path"}, {64, 0.05, "path"}, {16, 0.05, "light"}, {32, 0.03, "bidir"}}) {
    render::Settings with = settings_for(1);
    with.integrator = integrator;
    with.target_error = error;
    with.time_limit = 60; // in case the other condition fails
    const Render image = render_of(shipped("cornell-box", side, side), with);
    CAPTURE(side, error, integrator, image.film.samples_per_pixel());
    CHECK(image.film.relative_standard_error() <= error);
    CHECK(image.film.relative_standard_error() > 0.9 * error);
    CHECK(image.statistics.seconds_render < 60);
  }
}

TEST_CASE("an error is believed from some samples per pixel on") {
  render::Settings with = settings_for(1);
  with.target_error = 10;
  const Render image = render_of(shipped("cornell-box", 16, 16), with);
  CHECK(image.film.samples_per_pixel() >= film::least_samples);
  CHECK(image.film.samples_per_pixel() < 2 * film::least_samples);
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
