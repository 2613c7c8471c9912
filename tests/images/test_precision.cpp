// --precision double: the same images except for rounding.
#include <cmath>

#include <catch2/catch.hpp>

#include "errors.h"
#include "images/evidence.h"
#include "images/integrators.h"
#include "images/room.h"
#include "render/parts.h"

using namespace phlux;
using namespace phlux::test;
using Catch::Contains;

namespace {

bool device_has_doubles() {
  if (device::open_devices({}).front().info.doubles) return true;
  WARN("the device has no doubles");
  return false;
}

render::Settings in_double(render::Settings with) {
  with.double_precision = true;
  return with;
}

// The same seed in either precision: samples are the same except for rounding, which sometimes decides which
// of two surfaces a ray hits, or whether roulette ends a path.
void check_same_samples(const scene::Scene& scene, const Method& method, int samples) {
  CAPTURE(name_of(method));
  render::Settings with = settings_for(samples);
  with.integrator = method.integrator;
  with.lanes = 1;
  const Estimate a = estimate_of(render_of(scene, with).film);
  const Estimate b = estimate_of(render_of(scene, in_double(with)).film);
  std::size_t equal = 0, apart = 0;
  double sum_a = 0, sum_b = 0;
  for (std::size_t pixel = 0; pixel < a.mean.size(); ++pixel)
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = a.mean[pixel][c], y = b.mean[pixel][c];
      equal += x == y;
      apart += std::abs(x - y) > 1e-4 * x;
      sum_a += x;
      sum_b += y;
    }
  const std::size_t values = 3 * a.mean.size();
  CAPTURE(values, equal, apart, sum_b / sum_a);
  CHECK(equal < values / 2); // the arithmetic was in double precision
  CHECK(apart < values / 5);
  CHECK(std::abs(sum_b / sum_a - 1) < 1e-4);
}

} // namespace

TEST_CASE("doubles: one path at a time, on a device that has them") {
  device::DeviceInfo device;
  device.name = "pocket calculator";
  device.lanes = 16;
  render::Settings with;
  CHECK(render::lanes_for(device, with) == 16);
  with.double_precision = true;
  CHECK_THROWS_WITH(render::lanes_for(device, with), Contains("pocket calculator") &&
                                                         Contains("has no doubles") &&
                                                         Contains("`precision` single"));
  CHECK_THROWS_AS(render::lanes_for(device, with), DeviceError);
  device.doubles = true;
  CHECK(render::lanes_for(device, with) == 1);
  with.lanes = 1;
  CHECK(render::lanes_for(device, with) == 1);
  with.lanes = 8;
  CHECK_THROWS_WITH(render::lanes_for(device, with),
                    Contains("`precision` double") && Contains("leave `width` out"));
  CHECK_THROWS_AS(render::lanes_for(device, with), UsageError);
}

TEST_CASE("doubles: 2 at every pixel of the furnace box") {
  if (!device_has_doubles()) return;
  const scene::Scene scene = shipped("furnace-box", 8, 8);
  for (const Method& method : {path, bidir}) {
    CAPTURE(name_of(method));
    render::Settings with = in_double(settings_for(256));
    with.integrator = method.integrator;
    const Render box = render_of(scene, with);
    CHECK(box.statistics.lanes == 1);
    CHECK(box.statistics.nonfinite == 0);
    check_agreement(estimate_of(box.film), uniform(box.film, {2, 2, 2}));
  }
}

TEST_CASE("doubles: in a room of everything, light and path agree") {
  if (!device_has_doubles()) return;
  const scene::Scene scene = room({"rectangle", "mesh", "sphere", "spot", "constant"});
  check_against_path(scene, {light}, in_double(settings_for(64)), 4);
}

TEST_CASE("doubles: samples of a mesh with interpolated normals are those of floats") {
  if (!device_has_doubles()) return;
  check_same_samples(shipped("mesh", 24, 24), bidir, 16);
}
