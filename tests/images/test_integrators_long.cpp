// The long version of test_integrators.cpp, which prints a table: test_images "[.long]". Takes some tens of
// minutes.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "images/integrators.h"
#include "images/room.h"

using namespace phlux;
using namespace phlux::test;

namespace {

constexpr double largest_difference =
    0.002; // of the mean over the image, three standard errors of it as well
constexpr int renders = 32;

double mean_of(const Repeated& image) {
  const Channels& mean = image.mean.mean[0];
  return (mean[0] + mean[1] + mean[2]) / 3;
}
// Channels are correlated: the error of their mean is at most the mean of their errors.
double error_of(const Repeated& image) {
  const Channels& variance = image.mean.variance[0];
  return (std::sqrt(variance[0]) + std::sqrt(variance[1]) + std::sqrt(variance[2])) / 3;
}

// Takes as many samples as reduce three standard errors of the mean below 0.14%, so that those of a
// difference of two are below 0.2%; at most `most`.
Repeated precise(const scene::Scene& scene, const Method& method, std::uint64_t seed, int most) {
  render::Settings with = settings_for(32);
  with.seed = seed;
  Repeated image = repeated(scene, method, with, renders);
  while (3 * error_of(image) > largest_difference / std::sqrt(2) * mean_of(image) &&
         with.samples_per_pixel < most) {
    const double wanted =
        std::pow(3 * error_of(image) / (largest_difference / std::sqrt(2) * mean_of(image)), 2);
    with.samples_per_pixel = static_cast<int>(
        std::min(with.samples_per_pixel * std::max(1.5, 1.2 * wanted), static_cast<double>(most)));
    with.seed += 10'000;
    image = repeated(scene, method, with, renders);
  }
  return image;
}

void compare(const std::string& name, const scene::Scene& scene, const std::vector<Method>& methods,
             int most = 16384) {
  const Repeated reference = precise(scene, path, 1'000'000, most);
  fmt::print("{:32} {:15} {:10.6f} {:8.4f}%\n", name, "path", mean_of(reference),
             100 * error_of(reference) / mean_of(reference));
  std::uint64_t seed = 2'000'000;
  for (const Method& method : methods) {
    CAPTURE(name, name_of(method));
    const Repeated image = precise(scene, method, seed += 1'000'000, most);
    const double error = std::hypot(error_of(image), error_of(reference));
    const double difference = mean_of(image) - mean_of(reference);
    fmt::print("{:32} {:15} {:10.6f} {:8.4f}%  difference {:8.4f}%  z {:6.2f}\n", "", name_of(method),
               mean_of(image), 100 * error_of(image) / mean_of(image), 100 * difference / mean_of(reference),
               difference / error);
    std::fflush(stdout);
    check_methods(image, reference, 2);
    CHECK(std::abs(difference) <= std::max(largest_difference * mean_of(reference), 3 * error));
  }
}

const std::vector<Method> all_methods = {light, bidir, bidir_power, bidir_uniform};

} // namespace

TEST_CASE("means of every kind of emitter agree within 0.2% at three standard errors", "[.long]") {
  for (const std::string& kind : emitter_kinds()) compare("room, " + kind, room({kind}), all_methods);
  compare("room, all of them", room(emitter_kinds()), all_methods);
}

TEST_CASE("means of every shipped scene agree within 0.2% at three standard errors", "[.long]") {
  // Where surfaces meet, uniform weights leave 1 / distance^2 unbounded.
  for (const std::string& name : shipped_names()) {
    std::vector<Method> methods = {light, bidir, bidir_power};
    if (name == "furnace-sphere") methods = all_methods;
    const scene::Scene scene = shipped(name, 16, 16);
    if (has_delta(scene)) methods = {bidir, bidir_power}; // mirrors and glass are black in light tracing
    compare(name, scene, methods);
  }
}
