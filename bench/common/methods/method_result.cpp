#include "bench/common/methods/method_result.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "measure/moments.h"

namespace phlux::bench {
namespace {

// The relative standard error of a finite variance decreases with every sample, that of an infinite one does
// not. A variance is suspect if its relative standard error is above suspect_error; or above
// suspect_error_with_tail while the top share is above suspect_top_share; or if it grows from one sample per
// pixel to many by the factor suspect_growth.
constexpr double suspect_error = 0.25;
constexpr double suspect_error_with_tail = 0.1, suspect_top_share = 0.3;
constexpr double suspect_growth = 2.0;
// Of each test. About 60 rows with two tests each: a false alarm in 1% of the reports with normal means.
constexpr double significance_level = 1e-4;
constexpr double rounding = 1e-5; // relative error that float32 sums may give a mean, whatever its noise

double mean_samples(const ImageEstimate& image) {
  return std::accumulate(image.samples.begin(), image.samples.end(), 0.0) /
         static_cast<double>(image.samples.size());
}

} // namespace

const char* word_of(Verdict verdict) {
  constexpr std::array<const char*, 4> words = {"sound", "suspect", "biased", "refused"};
  return words[static_cast<std::size_t>(verdict)];
}

MethodRenders::TimedError MethodRenders::error_of(const Snapshot& snapshot, const Reference& reference) {
  return {snapshot.time, snapshot.seconds, mean_samples(snapshot.image),
          relative_mse(snapshot.image, reference)};
}

void MethodRenders::add(TimedRender render, const Reference& reference) {
  seconds_per_sample_.push_back(render.seconds_per_sample());
  processor_seconds_per_sample_.push_back(render.processor_seconds_per_sample);
  for (const Snapshot& snapshot : render.intermediate) errors_.push_back(error_of(snapshot, reference));
  errors_.push_back(error_of(render.last, reference));
  images_.push_back(std::move(render.last.image));
  one_sample_images_.push_back(std::move(*render.one_sample));
}

// Leaves out times for which fewer than half of the renders have an image.
std::vector<ConvergencePoint> MethodRenders::convergence() const {
  std::vector<ConvergencePoint> points;
  for (std::size_t time = 0; time <= doublings; ++time) {
    std::vector<double> seconds, samples, errors;
    for (const TimedError& error : errors_) {
      if (error.time != time) continue;
      seconds.push_back(error.seconds);
      samples.push_back(error.samples_per_pixel);
      errors.push_back(error.relmse);
    }
    if (2 * errors.size() < images_.size()) continue;
    const auto [least, most] = std::ranges::minmax(errors);
    const double mean =
        std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
    points.push_back({measure::median(seconds), measure::median(samples), mean, least, most,
                      static_cast<int>(errors.size())});
  }
  return points;
}

void MethodRenders::judge_mean(MethodResult& result, const ReferenceImage& reference,
                               const std::string& known_bias) const {
  const Estimate unexplained = unexplained_mse(images_, reference.radiance);
  const Estimate difference{result.mean.value - reference.mean.value,
                            std::hypot(result.mean.standard_error, reference.mean.standard_error)};
  if (difference.standard_error > 0) result.mean_bias_sigma = difference.value / difference.standard_error;
  // The error of the reference has fewer degrees of freedom than the rounds, but is a small part of the sum.
  const bool mean_differs = std::abs(difference.value) > rounding * reference.mean.value &&
                            p_value(difference, 0, images_.size()) < significance_level;
  const bool pixels_differ = unexplained.value > 2 * reference.relmse + rounding * rounding &&
                             p_value(unexplained, reference.relmse, images_.size()) < significance_level;
  if (!known_bias.empty())
    result.reason = known_bias;
  else if (mean_differs)
    result.reason = fmt::format("the image's mean is {:+.2g}% off the reference's ({:+.1f} sigma)",
                                100 * difference.value / reference.mean.value, result.mean_bias_sigma);
  else if (pixels_differ)
    result.reason = fmt::format("the variance does not explain a relative MSE of {:.2g}", unexplained.value);
  if (!known_bias.empty() || mean_differs || pixels_differ) result.verdict = Verdict::biased;
}

void MethodRenders::judge_variance(MethodResult& result, const Reference& reference) const {
  if (!(result.variance.value > 0)) {
    if (result.verdict == Verdict::sound) return;
    result.verdict = Verdict::suspect_variance;
    result.reason = "all renders are equal: the samples that carry the light were never drawn";
    return;
  }
  const double error = result.variance.standard_error / result.variance.value;
  if (error > suspect_error || (error > suspect_error_with_tail && result.top_share > suspect_top_share)) {
    result.verdict = Verdict::suspect_variance;
    result.reason =
        fmt::format("standard error of the variance {:.0f}%: the largest 0.1% of the samples hold "
                    "{:.0f}% of the squared error",
                    100 * error, 100 * result.top_share);
    return;
  }
  const Estimate growth = log_growth(images_, one_sample_images_, reference);
  if (growth.value > std::log(suspect_growth) && p_value(growth, 0, images_.size()) < significance_level) {
    result.verdict = Verdict::suspect_variance;
    result.reason =
        fmt::format("the variance grew {:.1f} times with the number of samples", std::exp(growth.value));
  }
}

MethodResult MethodRenders::result(const Method& method, const ReferenceImage& reference,
                                   const std::string& known_bias) const {
  MethodResult result{.method = method};
  result.rounds = static_cast<int>(images_.size());
  result.variance = variance_per_sample(images_, reference.radiance);
  result.top_share = top_share(one_sample_images_, reference.radiance);
  result.mean = image_mean(images_);
  result.seconds_per_sample = measure::median(seconds_per_sample_);
  result.processor_seconds_per_sample = measure::median(processor_seconds_per_sample_);
  const auto [least, most] = std::ranges::minmax(seconds_per_sample_);
  result.seconds_per_sample_least = least, result.seconds_per_sample_most = most;
  result.convergence = convergence();
  result.first_image = images_.front();
  judge_mean(result, reference, known_bias);
  // A few large samples that most renders lack also look like a bias: a suspect variance replaces that
  // verdict.
  if (known_bias.empty()) judge_variance(result, reference.radiance);
  return result;
}

} // namespace phlux::bench
