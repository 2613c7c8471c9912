// The anisotropic model of Ashikhmin and Shirley compared with its formulas and its sampler.
#include <cmath>
#include <numbers>
#include <vector>

#include "materials.h"
#include "sampling_test.h"

using namespace device_test;

namespace {

constexpr double pi = std::numbers::pi;

const std::vector<phlux::scene::Material> materials{anisotropic({.4, .3, .2}, {.05, .2, .5}, 10, 200),
                                                    anisotropic({0, 0, 0}, {.9, .8, .7}, 1000, 100),
                                                    anisotropic({.9, .5, .1}, {0, .02, .04}, 3, 0)};
constexpr double angles[] = {0, 40, 80}; // degrees

glm::dvec3 fixed_at(double degrees) {
  return as_float(polar(degrees * pi / 180, 0.7));
}

double fifth(double x) {
  return std::pow(x, 5);
}

// The same formulas in float64.
glm::dvec3 formula(const phlux::scene::Material& m, const glm::dvec3& k1, const glm::dvec3& k2) {
  if (k1.z <= 0 || k2.z <= 0) return glm::dvec3(0);
  const glm::dvec3 h = glm::normalize(k1 + k2);
  const double hk = glm::dot(h, k1), sine2 = h.x * h.x + h.y * h.y;
  const double weighted = phlux::test::exponent_of(m) * h.x * h.x + phlux::test::exponent_v_of(m) * h.y * h.y;
  const double power = sine2 > 0 ? std::exp(weighted / sine2 * 0.5 * std::log1p(-sine2)) : 1;
  const double lobe = std::sqrt((phlux::test::exponent_of(m) + 1) * (phlux::test::exponent_v_of(m) + 1)) /
                      (8 * pi) * power / (hk * std::max(k1.z, k2.z));
  const glm::dvec3 fresnel =
      phlux::test::specular_of(m) + (1.0 - phlux::test::specular_of(m)) * fifth(1 - hk);
  const double under = 28 / (23 * pi) * (1 - fifth(1 - k1.z / 2)) * (1 - fifth(1 - k2.z / 2));
  return lobe * fresnel + under * phlux::test::diffuse_of(m) * (1.0 - phlux::test::specular_of(m));
}

SphereGrid grid_of(const phlux::scene::Material& m, const glm::dvec3& fixed) {
  // A lobe of half vectors is about four times as wide, in solid angle, in the mirrored directions.
  auto cuts = lobe_cuts(phlux::test::exponent_of(m) / 4);
  for (const double cut : lobe_cuts(phlux::test::exponent_v_of(m) / 4)) cuts.push_back(cut);
  return {glm::normalize(glm::dvec3(-fixed.x, -fixed.y, fixed.z)), cuts};
}

} // namespace

TEST_CASE("anisotropic: the value is the formula's, the same both ways, and 0 below the surface") {
  Random random(41);
  std::vector<phlux::measure::Pair> pairs;
  for (std::size_t i = 0; i < thinned(8000); ++i) {
    const glm::dvec3 from = random.direction_above();
    const glm::dvec3 mirrored(-from.x, -from.y, from.z);
    const double spread = std::exp2(-random.uniform(0, 8));
    const glm::dvec3 to =
        i % 2 == 0 ? random.direction() : glm::normalize(mirrored + spread * random.point());
    pairs.push_back({as_float(from), as_float(to)});
  }
  pairs.push_back({{0, 0, 1}, {0, 0, 1}}); // h = N: 0/0 in the formula
  for (const Variant v : variants) {
    const DeviceModel model = device_model(v, materials, "mixture");
    for (int m = 0; m < static_cast<int>(materials.size()); ++m) {
      CAPTURE(v, m);
      const auto& material = materials[static_cast<std::size_t>(m)];
      const auto values = model.evaluate(m, pairs);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto& [from, to] = pairs[i];
        const auto right = formula(material, from, to);
        const auto &got = values[i].value, &other = values[i].reversed;
        CAPTURE(i, from.x, from.y, from.z, to.x, to.y, to.z);
        // The error of h is a few 2^-24 / (h.k), where h.k = |k1 + k2| / 2; (N.h)^n multiplies it by n
        // tan(h), and the rounding of its logarithm by n / (N.h)^2. The diffuse part, 1 - (1 - c/2)^5,
        // cancels at grazing angles. The lengths of k1 and k2 have errors of 2^-24, which k1.h magnifies if
        // they are nearly opposite.
        const double hk = glm::length(from + to) / 2;
        const glm::dvec3 h = glm::normalize(from + to);
        const double steep =
            1 + std::max(phlux::test::exponent_of(material), phlux::test::exponent_v_of(material)) *
                    std::hypot(h.x, h.y) / (h.z * h.z);
        const double tolerance =
            4e-6 + 4e-7 * steep / hk + 2e-7 / std::min(from.z, std::max(to.z, 1e-7)) + 2e-7 / (hk * hk);
        for (int channel = 0; channel < 3; ++channel) {
          REQUIRE(std::abs(got[channel] - right[channel]) <= tolerance * right[channel] + 1e-30);
          REQUIRE(std::abs(got[channel] - other[channel]) <= 2 * tolerance * right[channel] + 1e-30);
        }
        if (to.z <= 0) REQUIRE(got == glm::dvec3(0));
      }
    }
  }
}

TEST_CASE(
    "anisotropic: draws by its density, which integrates to no more than 1, and carries the reflectivity",
    "[slow]") {
  const std::size_t questions = std::size(variants) * materials.size() * std::size(angles) * 2 * 4;
  for (const Variant v : variants) {
    const DeviceModel model = device_model(v, materials, "exact");
    std::uint32_t seed = static_cast<std::uint32_t>(v.width) * 100 + (v.portable ? 50 : 0);
    for (int m = 0; m < static_cast<int>(materials.size()); ++m)
      for (const double angle : angles) {
        CAPTURE(v, m, angle);
        const glm::dvec3 fixed = fixed_at(angle);
        const SphereGrid grid = grid_of(materials[static_cast<std::size_t>(m)], fixed);
        auto cells = density_in_cells(model, m, fixed, grid);
        double integral = 0, below = 0;
        for (std::size_t cell = 0; cell < cells.size(); ++cell) integral += cells[cell];
        for (std::size_t cell = 0; cell < cells.size(); cell += 2) below += std::exchange(cells[cell], 0.0);
        CHECK(integral - below <= 1 + 1e-4);
        CHECK(integral - below >= 0.3);

        glm::dvec3 reflectivity(0);
        const auto nodes = grid.nodes();
        const auto values = evaluate(model, m, fixed, directions_of(nodes));
        for (std::size_t i = 0; i < nodes.size(); ++i)
          reflectivity += values[i].value * nodes[i].weight * nodes[i].direction.z;

        for (const bool roulette : {false, true}) {
          CAPTURE(roulette);
          const auto samples = model.sample(m, fixed, 20000, ++seed, roulette);
          CHECK(bad_weights(samples) == 0);
          CHECK(directions_p(samples, grid, cells) > one_of(questions));
          CHECK(weights_p(samples, reflectivity) > one_of(questions));
          if (!roulette) CHECK(disagreement(model, m, fixed, samples, true) < 2e-5);
        }
      }
  }
}

TEST_CASE("anisotropic: conserves energy beside an isotropic material in the same scene") {
  auto both = materials;
  both.push_back(phong({.3, .2, .1}, {.5, .5, .5}, 20));
  const DeviceModel model = device_model({8}, both, "mixture");
  for (int m = 0; m < static_cast<int>(both.size()); ++m)
    for (const double angle : angles) {
      CAPTURE(m, angle);
      glm::dvec3 sum(0);
      const std::size_t count = thinned(20000);
      const auto samples = model.sample(m, fixed_at(angle), count, 9, false);
      CHECK(bad_weights(samples) == 0);
      for (const Sample& s : samples) sum += s.weight;
      for (int channel = 0; channel < 3; ++channel)
        CHECK(sum[channel] <= (1 + 5 / std::sqrt(static_cast<double>(count))) * static_cast<double>(count));
    }
}
