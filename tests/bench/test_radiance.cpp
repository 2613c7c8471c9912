// The exact values of `phlux bench sampling`: quadrature against closed forms, one-dimensional integrals and
// means of samples from the device.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "bench/sampling/radiance.h"
#include "bench/sampling/sampler.h"
#include "measure/sampling_radiance.h"

using namespace phlux;
using namespace phlux::bench;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double disk_angle = MIRROR_DISK_DEGREES * pi / 180;

double disk(double angle) {
  return angle < disk_angle ? 1 / (1 - std::cos(disk_angle)) : 0;
}
double sky(double angle) {
  return 1 / (std::log(21) * (std::cos(angle) + 0.05));
}

// Simpson's rule on [0, to].
template<typename Function>
double simpson(const Function& function, double to) {
  constexpr int steps = 20000;
  double sum = function(0.0) + function(to);
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4 : 2) * function(to * i / steps);
  return sum * to / steps / 3;
}

} // namespace

TEST_CASE("Quadrature of constant light gives the closed form of the reflectivity") {
  for (const double exponent : {0., 1., 10., 90., 1e3, 1e4, 1e6})
    for (const double degrees : {0., 30., 60., 85., 89.9}) {
      CAPTURE(exponent, degrees);
      const Case one{.3, .5, exponent, degrees};
      CHECK(integrated_radiance(one, Light::constant) == Approx(exact_reflectivity(one)).epsilon(1e-8));
    }
}

TEST_CASE("At normal incidence the reflected radiance is an integral over one angle") {
  for (const double exponent : {0., 1., 10., 90., 1e3, 1e4})
    for (const auto& [light, radiance, to] : {std::tuple(Light::mirror_disk, &disk, disk_angle * (1 - 1e-15)),
                                              std::tuple(Light::horizon_sky, &sky, pi / 2)}) {
      CAPTURE(exponent, light_names()[static_cast<std::size_t>(light)]);
      const Case one{.3, .5, exponent, 0};
      const double expected = simpson(
          [&](double angle) {
            const double value = one.diffuse / pi + one.specular * (exponent + 2) / (2 * pi) *
                                                        std::pow(std::cos(angle), exponent);
            return value * radiance(angle) * std::cos(angle) * 2 * pi * std::sin(angle);
          },
          to);
      CHECK(reflected_radiance(one, light) == Approx(expected).epsilon(1e-7));
    }
}

TEST_CASE("Diffuse reflection does not depend on the angle for the sky, but on the height of the disk") {
  const double high = reflected_radiance({.5, 0, 1, 10}, Light::horizon_sky);
  CHECK(reflected_radiance({.5, 0, 1, 80}, Light::horizon_sky) == Approx(high).epsilon(1e-9));
  // A disk that is above the horizon has the irradiance of its centre's direction times (1 + cos(radius))
  // / 2.
  const double wide = pi * (1 + std::cos(disk_angle));
  for (const double degrees : {0., 40., 84.9})
    CHECK(reflected_radiance({.5, 0, 1, degrees}, Light::mirror_disk) ==
          Approx(.5 / pi * wide * std::cos(degrees * pi / 180)).epsilon(1e-9));
  CHECK(reflected_radiance({.5, 0, 1, 88}, Light::mirror_disk) >
        1.01 * .5 / pi * wide * std::cos(88 * pi / 180)); // the lower half of the disk is below the horizon
}

TEST_CASE("The constants of the kernel agree with the definitions") {
  CHECK(double(MIRROR_DISK_CHORD2) == Approx(4 * std::pow(std::sin(disk_angle / 2), 2)).epsilon(1e-7));
  CHECK(double(MIRROR_DISK_RADIANCE) == Approx(disk(0)).epsilon(1e-7));
  CHECK(double(HORIZON_SKY_SCALE) / (1 + double(HORIZON_SKY_HEIGHT)) == Approx(sky(0)).epsilon(1e-7));
  CHECK(double(HORIZON_SKY_SCALE) / double(HORIZON_SKY_HEIGHT) == Approx(sky(pi / 2)).epsilon(1e-7));
}

TEST_CASE("Means of device samples agree with the exact values, for every kind of light") {
  const device::Device device = device::open_devices({}).front();
  // 48 comparisons at 4.3 sigma: with random seeds, one run in 1200 would fail.
  constexpr double sigmas = 4.3;
  for (const std::string strategy : {"theta-phi", "cosine", "mixture", "exact"}) {
    Sampler sampler(device, {}, strategy, 0);
    for (const Light light : {Light::constant, Light::mirror_disk, Light::horizon_sky})
      for (const Case& one :
           {Case{.4, .4, 10, 60}, Case{.4, .05, 50, 88}, Case{.1, .8, 90, 30}, Case{.2, .7, 1, 85}}) {
        CAPTURE(strategy, light_names()[static_cast<std::size_t>(light)], one.exponent, one.degrees);
        const double exact = reflected_radiance(one, light);
        const auto run = sampler.run({one, light, has_roulette(strategy), exact, {{11, 3}}}, 1 << 19);
        CHECK(std::abs(bias_in_sigmas(moments_of(run.sums), exact)) < sigmas);
      }
  }
}
