// Diagnosis of a render: clamped light, contributions that are not finite.
#include <cmath>

#include <catch2/catch.hpp>

#include "errors.h"
#include "images/scenes.h"
#include "kernel_copy.h"

using namespace phlux;
using namespace phlux::test;

namespace {

double total(const film::Film& film) {
  double sum = 0.0;
  for (std::size_t pixel = 0; pixel < film.pixels().size(); ++pixel)
    for (const double channel : film.mean(pixel)) sum += channel;
  return sum;
}

Render render_by(const KernelCopy& kernels, const std::string& integrator, int samples) {
  render::Settings with = settings_for(samples);
  with.integrator = integrator;
  with.kernel_dir = kernels.folder();
  return render_of(shipped("cornell-box", 8, 8), with);
}

void check_origin(const Render& image, std::int64_t pixel, std::int64_t sample, int samples) {
  REQUIRE(image.statistics.first_nonfinite);
  CHECK(image.statistics.first_nonfinite->pixel == pixel);
  CHECK(image.statistics.first_nonfinite->sample == sample);
  CHECK(image.statistics.first_nonfinite->samples == samples);
  CHECK(std::isfinite(total(image.film)));
}

} // namespace

TEST_CASE("clamping takes away what it says, and nothing without being asked") {
  const scene::Scene scene = shipped("caustic", 16, 12);
  for (const std::string integrator : {"path", "light", "bidir"}) {
    CAPTURE(integrator);
    render::Settings with = settings_for(32);
    with.integrator = integrator;
    const Render whole = render_of(scene, with);
    CHECK(whole.film.clamped_share() == 0.0);
    with.clamp = 1.0;
    const Render clamped = render_of(scene, with);
    const double share = clamped.film.clamped_share();
    CHECK(share > 0.01);
    CHECK(share < 0.99);
    CHECK(total(clamped.film) == Approx((1.0 - share) * total(whole.film)).epsilon(1e-5));
    if (integrator != "path") continue;
    for (std::size_t pixel = 0; pixel < clamped.film.pixels().size(); ++pixel)
      for (const double channel : clamped.film.mean(pixel)) CHECK(channel <= 1.0 + 1e-6);
  }
  render::Settings with = settings_for(1);
  with.integrator = "bidir";
  with.techniques = true;
  with.clamp = 1.0;
  CHECK_THROWS_AS(render_of(scene, with), UsageError);
}

TEST_CASE("clamping is in radiance, whatever the unit of the light table") {
  scene::Scene scene = shipped("caustic", 8, 6);
  for (const std::string integrator : {"path", "light", "bidir"}) {
    CAPTURE(integrator);
    render::Settings with = settings_for(16);
    with.integrator = integrator;
    with.clamp = 1.0;
    const double share = render_of(scene, with).film.clamped_share();
    scene::Scene bright = scene;
    for (scene::AreaEmitter& light : bright.area_emitters) light.radiance *= 0x1p90;
    with.clamp = 0x1p90;
    CHECK(render_of(bright, with).film.clamped_share() == Approx(share).epsilon(1e-6));
  }
}

TEST_CASE("a sample that is not finite is dropped, counted, and its block is named") {
  const KernelCopy broken("transport/film.cl", "const Real total = radiance.x",
                          "const Mask chosen = (job->pixel == 37) & (sample_number(list, *job) == 21);\n"
                          "  radiance.x = chosen ? (Real)(NAN) : radiance.x;\n"
                          "  const Real total = radiance.x");
  const Render image = render_by(broken, "path", 64);
  CHECK(image.statistics.nonfinite == 1);
  check_origin(image, 37, 16, 16);
}

TEST_CASE("splats and connections that are not finite are dropped, counted, and their path is named") {
  // Path 0 of a batch: sample 0 of the first pixel of the batch.
  const KernelCopy broken("transport/contributions.cl", "Mask recorded = m;",
                          "Mask recorded = m;\n"
                          "  c.value.x = c.path == 0 ? (Real)(INFINITY) : c.value.x;");
  for (const std::string integrator : {"light", "bidir"}) {
    CAPTURE(integrator);
    const Render image = render_by(broken, integrator, 16);
    CHECK(image.statistics.nonfinite > 0);
    check_origin(image, 0, 0, 1);
  }
}
