// Every strategy compared with its density, the model and the closed form of the reflectivity.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "materials.h"
#include "phong/reflectivity.h"
#include "render/parts.h"
#include "sampling_test.h"

using namespace device_test;

namespace {

enum Traits : unsigned {
  none = 0,
  whole = 1,        // the weight is eval cos / density (else that of the sampled part)
  smooth = 2,       // the density ignores the lobe
  mean_density = 4, // the stated density is not that of the directions, but valid for MIS weights
  loses_energy = 8, // biased as printed
  no_peaks = 16     // needs n times as many draws or samples: no large exponents
};
struct Strategy {
  std::string name;
  unsigned traits;
};
const std::vector<Strategy> strategies{
    {"uniform", whole | smooth | no_peaks},
    {"theta-phi", whole | smooth | no_peaks},
    {"cosine", whole | smooth | no_peaks},
    {"disk", whole | smooth | no_peaks},
    {"rejection", whole | no_peaks},
    {"lobe-ks", none},
    {"lobe-estimate-printed", mean_density | loses_energy},
    {"lobe-estimate", mean_density},
    {"lobe-rho", none},
    {"mixture", whole},
    {"fold", whole},
    {"exact", whole},
};

const std::vector<phlux::scene::Material> materials{
    phong({.4, .3, .2}, {.5, .4, .3}, 10), phong({.1, .05, 0}, {.8, .6, .9}, 1000),
    phong({0, 0, 0}, {.9, .5, .1}, 3), phong({.2, .2, .2}, {.3, .3, .3}, 0)};
// At 0, 40 and 85 degrees to the normal, at an arbitrary longitude, to detect exchanges of x and y; and along
// the normal, with a cosine that rounding has made larger than 1.
std::vector<glm::dvec3> fixed_directions() {
  std::vector<glm::dvec3> directions{{0, 0, 1 + 0x1p-23}};
  for (const double degrees : {0.0, 40.0, 85.0})
    directions.push_back(as_float(polar(degrees * std::numbers::pi / 180, 1.1)));
  return directions;
}

struct Case {
  int material;
  glm::dvec3 fixed;
  glm::dvec3 reflectivity;
};

std::vector<Case> cases_of(const Strategy& strategy) {
  std::vector<Case> cases;
  for (std::size_t m = 0; m < materials.size(); ++m)
    for (const glm::dvec3& fixed : fixed_directions()) {
      if ((strategy.traits & no_peaks) != 0 && phlux::test::exponent_of(materials[m]) > 100) continue;
      const double lobe =
          phlux::phong::lobe_reflectivity(phlux::test::exponent_of(materials[m]), std::min(fixed.z, 1.0));
      cases.push_back(
          {static_cast<int>(m), fixed,
           phlux::test::diffuse_of(materials[m]) + phlux::test::specular_of(materials[m]) * lobe});
    }
  return cases;
}

SphereGrid grid_of(const Strategy& strategy, const Case& one) {
  if ((strategy.traits & smooth) != 0) return {{0, 0, 1}, {}};
  const glm::dvec3 mirrored(-one.fixed.x, -one.fixed.y, one.fixed.z);
  return {glm::normalize(mirrored),
          lobe_cuts(phlux::test::exponent_of(materials[static_cast<std::size_t>(one.material)]))};
}

// Number of statistical tests: directions and three channels of weights in each case, with and without
// roulette.
std::size_t questions() {
  std::size_t count = 0;
  for (const Strategy& strategy : strategies) count += 8 * cases_of(strategy).size() * std::size(variants);
  return count;
}

void check(const Strategy& strategy, Variant v, std::size_t count) {
  const DeviceModel model = device_model(v, materials, strategy.name);
  std::uint32_t seed = static_cast<std::uint32_t>(v.width) * 1000 + (v.portable ? 500 : 0);
  for (const Case& one : cases_of(strategy)) {
    CAPTURE(one.material, one.fixed.z);
    const SphereGrid grid = grid_of(strategy, one);
    const auto cells = density_in_cells(model, one.material, one.fixed, grid);
    double integral = 0;
    for (const double cell : cells) integral += cell;
    CHECK(integral == Approx(1).margin(1e-4)); // the table of reflectivities has an error of 7e-5
    for (const bool roulette : {false, true}) {
      CAPTURE(roulette);
      const auto samples = model.sample(one.material, one.fixed, count, ++seed, roulette);
      CHECK(bad_weights(samples) == 0);
      if ((strategy.traits & mean_density) == 0)
        CHECK(directions_p(samples, grid, cells) > one_of(questions()));
      const double p = weights_p(samples, one.reflectivity);
      if ((strategy.traits & loses_energy) == 0) CHECK(p > one_of(questions()));
      if (!roulette)
        CHECK(disagreement(model, one.material, one.fixed, samples, (strategy.traits & whole) != 0) < 2e-5);
    }
  }
}

} // namespace

TEST_CASE("phong: the list of strategies here is the program's") {
  std::vector<std::string> names;
  for (const Strategy& strategy : strategies) names.push_back(strategy.name);
  CHECK(names == phlux::render::strategy_names());
}

TEST_CASE("phong: each strategy draws by its density, carries the reflectivity, and survives accordingly",
          "[slow]") {
  for (const Strategy& strategy : strategies) DYNAMIC_SECTION(strategy.name) {
      for (const Variant v : variants) {
        CAPTURE(v);
        check(strategy, v, 20000);
      }
    }
}

TEST_CASE("phong: the energy loss of the printed estimate is as derived") {
  // A black diffuse part, n = 50 at 80 degrees: 10.7 percent.
  const DeviceModel model =
      device_model({1}, {phong(glm::dvec3(0), glm::dvec3(1), 50)}, "lobe-estimate-printed");
  const glm::dvec3 fixed = as_float(polar(80 * std::numbers::pi / 180, 0.3));
  double sum = 0;
  const std::size_t count = thinned(400000);
  for (const Sample& s : model.sample(0, fixed, count, 77, true)) sum += s.survives ? s.weight.x : 0;
  const double lobe = phlux::phong::lobe_reflectivity(50, fixed.z);
  CHECK(sum / static_cast<double>(count) / lobe ==
        Approx(1 - 0.107).margin(5 / std::sqrt(static_cast<double>(count))));
}

TEST_CASE("phong: every strategy's functions run") { // few samples, for oclgrind
  for (const Strategy& strategy : strategies) {
    CAPTURE(strategy.name);
    const DeviceModel model = device_model({4}, materials, strategy.name);
    for (const Case& one : cases_of(strategy))
      CHECK(bad_weights(model.sample(one.material, one.fixed, 16, 1, true)) == 0);
  }
}

TEST_CASE("phong: without a lobe in the scene, a diffuse surface") {
  const std::vector<phlux::scene::Material> diffuse{phong({.8, .5, .2}, glm::dvec3(0), 0)};
  const glm::dvec3 fixed = as_float(polar(1.0, 1.1));
  for (const Variant v : variants) {
    CAPTURE(v);
    const DeviceModel model = device_model(v, diffuse, "exact");
    const SphereGrid grid({0, 0, 1}, {});
    const auto cells = density_in_cells(model, 0, fixed, grid);
    for (const bool roulette : {false, true}) {
      const auto samples = model.sample(0, fixed, thinned(20000), 5, roulette);
      CHECK(bad_weights(samples) == 0);
      CHECK(directions_p(samples, grid, cells) > one_of(8 * std::size(variants)));
      CHECK(weights_p(samples, {.8, .5, .2}) > one_of(8 * std::size(variants)));
    }
  }
}
