#include "bench/precision/precision_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace phlux::bench {
namespace {

// Relative errors are relative to sqrt(value^2 + smallest_scale^2), as in files::compare.
constexpr double smallest_scale = 1e-2;
constexpr double least_noise = 1e-6; // relative standard error below which a value counts as noise-free

} // namespace

PrecisionPairs pairs_of(const std::vector<film::Film>& float32, const std::vector<film::Film>& float64) {
  PrecisionPairs pairs;
  for (const film::Film& film : float32) pairs.float32.push_back(estimate_of(film));
  for (const film::Film& film : float64) pairs.float64.push_back(estimate_of(film));
  const auto count = static_cast<double>(float64.size());
  for (std::size_t value = 0; value < 3 * float64.front().pixels().size(); ++value) {
    double sum = 0;
    for (const film::Film& film : float64) sum += film.variance_of_mean(value / 3)[value % 3];
    pairs.variance.push_back(sum / (count * count));
  }
  return pairs;
}

PrecisionError precision_error(const PrecisionPairs& pairs) {
  const ImageEstimate exact = pooled(pairs.float64);
  const Reference reference = exact_reference(exact.radiance);
  // The mean of float64 plus the difference of each pair: images whose noise comes from samples on other
  // paths, and whose bias is that of float32.
  std::vector<ImageEstimate> shifted = pairs.float32;
  for (std::size_t i = 0; i < shifted.size(); ++i)
    for (std::size_t value = 0; value < reference.radiance.size(); ++value)
      shifted[i].radiance[value] += reference.radiance[value] - pairs.float64[i].radiance[value];

  PrecisionError error;
  error.variance = mean_of(variances_per_sample(pairs.float64, reference)).value;
  const double unit = error.variance / unit_samples;
  const auto in_units = [&](double mse) { return unit > 0 ? std::sqrt(std::max(mse, 0.0) / unit) : 0.0; };
  const Estimate systematic = unexplained_mse(shifted, reference);
  error.systematic = in_units(systematic.value);
  error.systematic_most = in_units(systematic.value + 2 * systematic.standard_error);
  error.difference = in_units(std::max(systematic.value, 0.0) +
                              mean_of(variances_per_sample(shifted, reference)).value / unit_samples);
  double mean = 0;
  for (const double value : reference.radiance)
    mean += value / static_cast<double>(reference.radiance.size());
  const Estimate shifted_mean = mean_of(image_means(shifted));
  if (mean > 0) error.mean = {shifted_mean.value / mean - 1, shifted_mean.standard_error / mean};

  const ImageEstimate all = pooled(shifted);
  double quiet = 0;
  for (std::size_t value = 0; value < reference.radiance.size(); ++value) {
    const double d = std::abs(all.radiance[value] - reference.radiance[value]);
    const double scale = std::hypot(reference.radiance[value], smallest_scale);
    const double sigma = std::sqrt(pairs.variance[value] * exact.samples[value / 3] / unit_samples);
    const bool noisy = sigma > least_noise * scale;
    if (noisy) error.largest = std::max(error.largest, d / sigma);
    if (!noisy) error.quiet_difference = std::max(error.quiet_difference, d / scale);
    quiet += noisy ? 0 : 1;
  }
  error.quiet_share = quiet / static_cast<double>(reference.radiance.size());
  return error;
}

// Solves systematic^2 V / unit_samples + V / (times_as_fast n) = V / n for n.
double break_even_samples(double systematic, double times_as_fast) {
  if (times_as_fast <= 1) return 0;
  if (systematic <= 0) return std::numeric_limits<double>::infinity();
  return unit_samples * (1 - 1 / times_as_fast) / (systematic * systematic);
}

} // namespace phlux::bench
