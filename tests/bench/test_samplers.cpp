#include "bench/samplers/samplers.h"

#include <cmath>

#include <catch2/catch.hpp>

using namespace phlux;
using namespace phlux::bench;
using Catch::Contains;

namespace {

// An error of c samples^slope, with this relative standard error of the variance.
SamplerError error_of(const std::string& sampler, int samples, double slope, double relative = 0.1) {
  const double variance = 3.0 * std::pow(samples, 2 * slope) * samples;
  return {"a", "path", sampler, samples, {variance, relative * variance, 9}, {1, 0, 9}, 100, 1};
}

} // namespace

TEST_CASE("Numbers of samples are the largest and quarters of it, down to 16") {
  SamplersOptions options;
  CHECK(sample_counts(options) == std::vector{16, 64, 256, 1024});
  options.samples = 100;
  CHECK(sample_counts(options) == std::vector{25, 100});
  options.samples = 4;
  CHECK(sample_counts(options) == std::vector{4});
}

TEST_CASE("The slope of the error is fitted, with its standard error") {
  std::vector<SamplerError> errors;
  for (const int samples : {16, 64, 256, 1024}) errors.push_back(error_of("sobol", samples, -0.75));
  const Estimate slope = slope_of(errors);
  CHECK(slope.value == Approx(-0.75));
  // Half of .1, divided by the root of the sum of squared distances from the mean of log(samples).
  CHECK(slope.standard_error == Approx(0.05 / (std::log(4.0) * std::sqrt(2 * (1.5 * 1.5 + 0.5 * 0.5)))));
  CHECK(std::isnan(slope_of({errors.front()}).value));
}

TEST_CASE(
    "The answer on samplers: time to the same error at the largest number of samples, the least first") {
  std::vector<SamplerError> errors;
  for (const char* scene : {"a", "b"})
    for (const int samples : {16, 64})
      for (const char* sampler : {"independent", "lattice", "sobol"}) {
        SamplerError error = error_of(sampler, samples, -0.5);
        error.scene = scene;
        if (samples == 64 && error.sampler != "independent") {
          const bool lattice = error.sampler == "lattice";
          error.gain = {lattice ? 2.0 : 4.0, lattice ? 0.02 : 0.04, 9};
          error.time_ratio = lattice ? 1.2 : 2.0;
          if (error.scene == "b") error.time_ratio *= 1.21;
        }
        errors.push_back(error);
      }
  const std::vector<std::string> answers = sampler_answers(errors);
  REQUIRE(answers.size() == 1);
  CHECK_THAT(answers[0],
             Contains("path: for the error of 64 independent samples per pixel, --sampler sobol needs "
                      "0.550 (95%: 0.54") &&
                 Contains(") times the time and --sampler lattice needs 0.660 (95%: 0.6"));
}
