// The modified Phong model: evaluation, and reflectivity on host and device.
#include <cmath>
#include <numbers>
#include <vector>

#include "device_test.h"
#include "material_test.h"
#include "materials.h"
#include "phong/reflectivity.h"

using namespace device_test;

namespace {

constexpr double pi = std::numbers::pi;

// The same formulas in float64.
glm::dvec3 phong_formula(const phlux::scene::Material& m, const glm::dvec3& a, const glm::dvec3& b) {
  if (a.z <= 0 || b.z <= 0) return glm::dvec3(0);
  const glm::dvec3 mirrored(-a.x, -a.y, a.z);
  const double half = glm::length(mirrored - b) / 2; // sine of half of alpha
  const double power =
      half * half < 0.5 ? std::exp(phlux::test::exponent_of(m) * std::log1p(-2 * half * half)) : 0;
  return phlux::test::diffuse_of(m) / pi +
         phlux::test::specular_of(m) * ((phlux::test::exponent_of(m) + 2) / (2 * pi) * power);
}

} // namespace

TEST_CASE("phong: known values at normal incidence") {
  const std::vector<phlux::scene::Material> materials{
      phong(glm::dvec3(.5), glm::dvec3(.5), 10), phong(glm::dvec3(1), glm::dvec3(0), 10),
      phong(glm::dvec3(0), glm::dvec3(1), 10), phong(glm::dvec3(0), glm::dvec3(0), 10)};
  const double expected[] = {7 / (2 * pi), 1 / pi, 6 / pi, 0};
  for (const Variant v : variants) {
    const DeviceModel model = device_model(v, materials, "mixture");
    for (int i = 0; i < 4; ++i) {
      CAPTURE(v, i);
      const auto value = model.evaluate(i, {{{0, 0, 1}, {0, 0, 1}}})[0].value;
      CHECK(value.x == Approx(expected[i]).epsilon(3e-7));
      CHECK(value.y == value.x);
      CHECK(value.z == value.x);
    }
  }
}

TEST_CASE("phong: the value is the formula's, the same both ways, and 0 below the surface") {
  const std::vector<phlux::scene::Material> materials{
      phong({.4, .3, .2}, {.5, .4, .3}, 10), phong({.1, 0, .5}, {.8, .9, 0}, 1e4),
      phong({.3, .3, .3}, {.3, .2, .1}, 0), phong({0, .1, 0}, {1, .9, .5}, 1e6)};
  Random random(31);
  std::vector<phlux::measure::Pair> pairs;
  for (std::size_t i = 0; i < thinned(8000); ++i) {
    const glm::dvec3 from = random.direction_above();
    // Half of them near the tip of the lobe: at n = 1e6 it is a thousandth of a radian wide.
    const glm::dvec3 mirrored(-from.x, -from.y, from.z);
    const double spread = std::exp2(-random.uniform(0, 12));
    const glm::dvec3 to =
        i % 2 == 0 ? random.direction() : glm::normalize(mirrored + spread * random.point());
    pairs.push_back({as_float(from), as_float(to)});
  }
  for (const Variant v : variants) {
    const DeviceModel model = device_model(v, materials, "mixture");
    for (int m = 0; m < static_cast<int>(materials.size()); ++m) {
      CAPTURE(v, m);
      const auto values = model.evaluate(m, pairs);
      const auto& material = materials[static_cast<std::size_t>(m)];
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto& [a, b] = pairs[i];
        const auto right = phong_formula(material, a, b);
        const auto &got = values[i].value, &other = values[i].reversed;
        // Components of directions have errors of 2^-25, so the relative error of the power of cos(alpha) is
        // about n |sin alpha| 2^-24.
        const glm::dvec3 mirrored(-a.x, -a.y, a.z);
        const double sine = glm::length(mirrored - b);
        const double tolerance = 3e-6 + 2e-7 * phlux::test::exponent_of(material) * sine;
        for (int channel = 0; channel < 3; ++channel) {
          REQUIRE(std::abs(got[channel] - right[channel]) <= tolerance * right[channel] + 1e-30);
          REQUIRE(std::abs(got[channel] - other[channel]) <= 1e-6 * right[channel] + 1e-30);
        }
        if (b.z <= 0) REQUIRE(got == glm::dvec3(0));
      }
    }
  }
}

TEST_CASE("phong: reflectivity on the device is the closed form's to the table's 7e-5") {
  const double exponents[] = {0, 0.5, 1, 10, 50, 1000, 1e5, 1e6};
  std::vector<phlux::scene::Material> materials;
  for (const double n : exponents) materials.push_back(phong({.1, .2, .3}, {.9, .4, 0}, n));
  std::vector<double> cosines{0, 1};
  for (int i = 0; i < 1000; ++i) cosines.push_back(static_cast<float>(std::pow((i + 0.5) / 1000, 2)));
  for (const Variant v : variants) {
    const DeviceModel model = device_model(v, materials, "lobe-rho");
    for (std::size_t m = 0; m < materials.size(); ++m) {
      CAPTURE(v, exponents[m]);
      const auto values = model.reflectivity(static_cast<int>(m), cosines);
      for (std::size_t i = 0; i < cosines.size(); ++i) {
        const double lobe = phlux::phong::lobe_reflectivity(exponents[m], cosines[i]);
        const glm::dvec3 right =
            phlux::test::diffuse_of(materials[m]) + phlux::test::specular_of(materials[m]) * lobe;
        for (int channel = 0; channel < 3; ++channel)
          REQUIRE(std::abs(values[i][channel] - right[channel]) <= 7e-5 * right[channel] + 2e-7);
      }
    }
  }
}

TEST_CASE("phong: a black material beside others carries nothing on") {
  const std::vector<phlux::scene::Material> materials{phong({.1, .2, .3}, {.9, .4, 0}, 5),
                                                      phong(glm::dvec3(0), glm::dvec3(0), 0)};
  const glm::dvec3 fixed(0.6, 0, 0.8);
  for (const char* strategy : {"cosine", "mixture", "exact"}) {
    const DeviceModel model = device_model({1}, materials, strategy);
    CAPTURE(strategy);
    for (const Sample& s : model.sample(1, fixed, 100, 1, false)) {
      REQUIRE(s.weight.x == 0);
      REQUIRE(s.weight.y == 0);
      REQUIRE(s.weight.z == 0);
    }
  }
}
