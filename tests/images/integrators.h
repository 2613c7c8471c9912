// Path tracing, light tracing and bidirectional path tracing side by side.
#pragma once

#include <string>
#include <vector>

#include "images/scenes.h"
#include "images/welch.h"

namespace phlux::test {

struct Method {
  std::string integrator = "path";
  render::Weights weights = render::Weights::balance; ///< bidir
  render::Connect connect = render::Connect::mis;     ///< path
  render::Sampler sampler = render::Sampler::independent;
  bool operator==(const Method&) const = default;
};

[[nodiscard]] std::string name_of(const Method& method);

inline const Method path{"path"}, light{"light"}, bidir{"bidir"},
    bidir_power{"bidir", render::Weights::power}, bidir_uniform{"bidir", render::Weights::uniform},
    path_hits{"path", render::Weights::balance, render::Connect::none},
    path_light_samples{"path", render::Weights::balance, render::Connect::light},
    path_sobol{"path", render::Weights::balance, render::Connect::mis, render::Sampler::sobol},
    path_lattice{"path", render::Weights::balance, render::Connect::mis, render::Sampler::lattice},
    bidir_sobol{"bidir", render::Weights::balance, render::Connect::mis, render::Sampler::sobol},
    bidir_lattice{"bidir", render::Weights::balance, render::Connect::mis, render::Sampler::lattice};

/// The settings for this method.
[[nodiscard]] render::Settings by(const Method& method, render::Settings settings);
/// A render with `samples` samples per pixel by this method.
[[nodiscard]] render::Settings settings_for(const Method& method, int samples, int max_depth = -1);

/// Means of independent renders. A path may contribute to several pixels, so pixels are not independent: the
/// variance of the image's mean is estimated from the differences between renders.
struct Repeated {
  Estimate image; ///< variances as the films say
  Estimate mean;  ///< of the whole image, as one pixel; variance from `renders` of them
  int renders = 0;
};

[[nodiscard]] Repeated repeated(const scene::Scene& scene, const Method& method, render::Settings with,
                                int renders = 16);

/// The z-tests of agreement() for tiles of `side` x `side` pixels and, instead of its test of the image's
/// mean, Welch's t-test of the means of the renders. The probability of a false alarm is false_alarm_rate for
/// each.
void check_methods(const Repeated& image, const Repeated& reference, int side = 1,
                   double tolerance = rounding);

/// Renders by each of `methods` with different seeds and compares them with path tracing.
void check_against_path(const scene::Scene& scene, const std::vector<Method>& methods,
                        const render::Settings& with, int side = 1);

} // namespace phlux::test
