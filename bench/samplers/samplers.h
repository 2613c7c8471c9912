// Measures samplers in whole renders: the error as a function of the number of samples per pixel.
#pragma once

#include <string>
#include <vector>

#include "bench/common/methods/image_estimates.h"
#include "bench/common/round_options.h"
#include "settings/settings.h"

namespace phlux::bench {

/// `samples` is the largest number of samples per pixel. Without scenes: shipped_scenes().
struct SamplersOptions : RoundOptions {
  std::vector<std::string> integrators = {"path", "bidir"};
  std::vector<std::string> samplers = settings::sampler_names(); ///< compared with independent
};

/// The numbers of samples per pixel that are measured, in ascending order: the largest, and a quarter of each
/// down to 16.
[[nodiscard]] std::vector<int> sample_counts(const SamplersOptions& options);

/// The error with one sampler on one scene by one integrator, at one number of samples per pixel.
struct SamplerError {
  std::string scene, integrator, sampler;
  int samples = 0;
  Estimate variance;     ///< relative, per sample: relative MSE x samples
  Estimate gain;         ///< variance with independent samples / this variance
  double ns = 0;         ///< time of a sample, in nanoseconds
  double time_ratio = 1; ///< time of a sample / that of an independent one: median over the rounds

  /// Time to the same error, relative to independent samples.
  [[nodiscard]] Estimate relative_time() const {
    const double value = time_ratio / gain.value;
    return {value, value * gain.standard_error / gain.value, gain.degrees};
  }
};

/// The exponent a of the error = c samples^a, by least squares over the logarithms. -0.5 with independent
/// samples. `errors`: those of one sampler by different numbers of samples. NaN for one number.
[[nodiscard]] Estimate slope_of(const std::vector<SamplerError>& errors);

/// For each integrator a sentence with the relative_time() of each sampler at the largest number of samples:
/// geometric mean over the scenes and its 95% interval, the least first. `errors` must have every sampler on
/// every scene.
[[nodiscard]] std::vector<std::string> sampler_answers(const std::vector<SamplerError>& errors);

/// Writes samplers.csv (bench/README.md), then its charts and its section of the report. Returns false if
/// interrupted. @throws UsageError, SceneError, DeviceError, WriteError
[[nodiscard]] bool measure_samplers(const SamplersOptions& options);

} // namespace phlux::bench
