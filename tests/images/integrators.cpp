#include "images/integrators.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "images/evidence.h"
#include "images/prepared_render.h"
#include "measure/statistics.h"

namespace phlux::test {
std::string name_of(const Method& method) {
  if (method.connect != render::Connect::mis)
    return method.connect == render::Connect::none ? "path, hits" : "path, light samples";
  if (method.sampler != render::Sampler::independent)
    return method.integrator + (method.sampler == render::Sampler::sobol ? ", sobol" : ", lattice");
  if (method.integrator != "bidir") return method.integrator;
  return method.weights == render::Weights::balance ? "bidir, balance"
         : method.weights == render::Weights::power ? "bidir, power"
                                                    : "bidir, uniform";
}

render::Settings by(const Method& method, render::Settings settings) {
  settings.integrator = method.integrator;
  settings.weights = method.weights;
  settings.connect = method.connect;
  settings.sampler = method.sampler;
  return settings;
}

render::Settings settings_for(const Method& method, int samples, int max_depth) {
  return by(method, settings_for(samples, max_depth));
}

Repeated repeated(const scene::Scene& scene, const Method& method, render::Settings with, int renders) {
  with = by(method, with);
  const PreparedRender prepared(scene, with);
  std::vector<Channels> means;
  Repeated result;
  result.renders = renders;
  for (int i = 0; i < renders; ++i) {
    const auto one = prepared.image(with.seed + static_cast<std::uint64_t>(i), with.samples_per_pixel);
    CHECK(one.nonfinite == 0);
    const Estimate image = estimate_of(one.film);
    if (i == 0)
      result.image = closed_form(image.width, image.height, std::vector<Channels>(image.mean.size()));
    Channels mean{};
    for (std::size_t pixel = 0; pixel < image.mean.size(); ++pixel)
      for (std::size_t c = 0; c < mean.size(); ++c) {
        result.image.mean[pixel][c] += image.mean[pixel][c] / renders;
        result.image.variance[pixel][c] += image.variance[pixel][c] / renders / renders;
        mean[c] += image.mean[pixel][c] / static_cast<double>(image.mean.size());
      }
    means.push_back(mean);
  }
  result.mean = closed_form(1, 1, {Channels{}});
  for (std::size_t c = 0; c < 3; ++c) {
    for (const Channels& mean : means) result.mean.mean[0][c] += mean[c] / renders;
    for (const Channels& mean : means)
      result.mean.variance[0][c] +=
          std::pow(mean[c] - result.mean.mean[0][c], 2) / (static_cast<double>(renders) * (renders - 1));
  }
  return result;
}

namespace {

// Below this fraction of the image's mean, a tile may have too few nonzero samples to estimate their
// variance.
constexpr double faint = 1e-4;

double mean_of(const std::vector<Channels>& values, std::size_t channel) {
  double sum = 0;
  for (const Channels& value : values) sum += value[channel];
  return sum / static_cast<double>(values.size());
}

// Where `expected` is faint, nonzero samples are Poisson events: the variance of a mean is that of the whole
// image per unit of radiance, times the expected radiance. The sample variance would be 0 without such
// samples.
Estimate with_variance_of_faint(Estimate image, const Estimate& expected) {
  for (std::size_t c = 0; c < 3; ++c) {
    const double light = mean_of(image.mean, c);
    if (light == 0) continue;
    const double variance_per_light = mean_of(image.variance, c) / light;
    for (std::size_t i = 0; i < image.mean.size(); ++i)
      if (expected.mean[i][c] < faint * light)
        image.variance[i][c] = std::max(image.variance[i][c], expected.mean[i][c] * variance_per_light);
  }
  return image;
}

} // namespace

void check_methods(const Repeated& image, const Repeated& reference, int side, double tolerance) {
  const Estimate tiled = tiles(image.image, side), tiled_reference = tiles(reference.image, side);
  check_agreement_of_pixels(with_variance_of_faint(tiled, tiled_reference),
                            with_variance_of_faint(tiled_reference, tiled), tolerance);
  const double level = measure::sidak_limit(false_alarm_rate, 3);
  for (std::size_t c = 0; c < 3; ++c) {
    const double a = image.mean.mean[0][c], b = reference.mean.mean[0][c];
    const double allowed = tolerance * std::max(std::abs(a), std::abs(b));
    const double p = welch_p(a, image.mean.variance[0][c], std::clamp(a, b - allowed, b + allowed),
                             reference.mean.variance[0][c], image.renders);
    const std::string message = fmt::format(
        "the mean of channel {}: {:.6g} +- {:.2g} where {:.6g} +- {:.2g} is expected, p {:.3g}", "RGB"[c], a,
        std::sqrt(image.mean.variance[0][c]), b, std::sqrt(reference.mean.variance[0][c]), p);
    check({p >= level, message}, tiled, tiled_reference, tolerance);
  }
}

void check_against_path(const scene::Scene& scene, const std::vector<Method>& methods,
                        const render::Settings& with, int side) {
  const Repeated reference = repeated(scene, path, with);
  render::Settings other = with;
  for (const Method& method : methods) {
    INFO(name_of(method));
    other.seed += 1000;
    check_methods(repeated(scene, method, other), reference, side);
  }
}

} // namespace phlux::test
