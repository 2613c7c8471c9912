#include "bench/common/methods/method_result.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "measure/moments.h"
#include "measure/statistics.h"

namespace phlux::bench {
namespace {

// The relative standard error of a finite variance decreases with every sample, that of an infinite one does
// not. A variance is suspect if its relative standard error is above tail_error while the top share is above
// suspect_top_share, or if it grows from one sample per pixel to many by the factor suspect_growth.
constexpr double tail_error = 0.1, suspect_top_share = 0.3;
constexpr double suspect_growth = 2.0, growth_level = 1e-4;
// A difference is a bias only at 4.5 standard errors, as a p-value of the t distribution.
constexpr double bias_level = 6.8e-6;
// A method is undecided while its variance is known to less than largest_error, or while a bias of
// detectable_bias would not be found.
constexpr double largest_error = 0.25, detectable_bias = 0.1;
constexpr double rounding = 1e-5; // relative error that float32 sums may give a mean, whatever its noise

double mean_samples(const ImageEstimate& image) {
  return std::accumulate(image.samples.begin(), image.samples.end(), 0.0) /
         static_cast<double>(image.samples.size());
}

SampleTime sample_time(const std::vector<RoundCost>& rounds, double RoundCost::*member) {
  std::vector<double> seconds;
  for (const RoundCost& round : rounds) seconds.push_back(round.*member);
  const auto [least, most] = std::ranges::minmax(seconds);
  return {measure::median(seconds), least, most};
}

} // namespace

const char* word_of(Verdict verdict) {
  constexpr std::array<const char*, 5> words = {"sound", "suspect", "biased", "undecided", "refused"};
  return words[static_cast<std::size_t>(verdict)];
}

MethodRenders::TimedError MethodRenders::error_of(const Snapshot& snapshot, const Reference& reference) {
  return {snapshot.time, snapshot.seconds, mean_samples(snapshot.image),
          relative_mse(snapshot.image, reference)};
}

void MethodRenders::add(TimedRender render, const Reference& reference) {
  costs_.push_back({0, render.seconds_per_sample, render.processor_seconds_per_sample});
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

Estimate MethodRenders::variance(const Reference& reference) const {
  return mean_of(variances_per_sample(images_, reference));
}

bool MethodRenders::suspect(MethodResult& result, const ReferenceImage& reference,
                            std::span<const double> variances) const {
  const double error = result.variance.standard_error / result.variance.value;
  if (error > tail_error && result.top_share > suspect_top_share) {
    result.decide(Verdict::suspect_variance,
                  fmt::format("standard error of the variance {:.0f}%: the largest 0.1% of the samples hold "
                              "{:.0f}% of the squared error",
                              100 * error, 100 * result.top_share),
                  error / tail_error);
    return true;
  }
  const Estimate growth = log_growth(variances, variances_per_sample(one_sample_images_, reference.image));
  if (!(growth.value > std::log(suspect_growth)) || p_value_above(growth, 0) > growth_level) return false;
  result.decide(
      Verdict::suspect_variance,
      fmt::format("the variance grew {:.1f} times with the number of samples", std::exp(growth.value)));
  return true;
}

// Rare large samples that most renders lack also look like a bias, so that the variance is judged first.
void MethodRenders::judge(MethodResult& result, const ReferenceImage& reference,
                          std::span<const double> variances) const {
  const Estimate difference = difference_of(result.mean, reference.mean);
  if (difference.standard_error > 0) result.mean_bias_sigma = difference.value / difference.standard_error;
  const bool mean_differs =
      std::abs(difference.value) > rounding * reference.mean.value && p_value(difference, 0) < bias_level;
  const Estimate unexplained = unexplained_mse(images_, reference.image);
  const bool pixels_differ =
      unexplained.value > rounding * rounding && p_value_above(unexplained, 0) < bias_level;
  if (!(result.variance.value > 0)) {
    if (mean_differs || pixels_differ)
      result.decide(Verdict::suspect_variance,
                    "all renders are equal: samples that carry light were never drawn");
    return;
  }
  if (suspect(result, reference, variances)) return;
  if (mean_differs)
    return result.decide(
        Verdict::biased,
        fmt::format(
            "the mean of the image differs from that of the reference by {:+.2g}% ({:+.1f} standard errors)",
            100 * difference.value / reference.mean.value, result.mean_bias_sigma));
  if (pixels_differ)
    return result.decide(Verdict::biased, fmt::format("the variances do not explain a relative MSE of {:.2g}",
                                                      unexplained.value));
  const double error = result.variance.standard_error / result.variance.value;
  const double detectable =
      measure::student_t(bias_level, difference.degrees) * difference.standard_error / reference.mean.value;
  if (error > largest_error)
    result.decide(Verdict::undecided, fmt::format("standard error of the variance {:.0f}%", 100 * error),
                  error / largest_error);
  else if (detectable > detectable_bias)
    result.decide(Verdict::undecided,
                  fmt::format("a bias of less than {:.0f}% would not be found", 100 * detectable),
                  detectable / detectable_bias);
}

void MethodResult::decide(Verdict v, const std::string& why, double error_ratio) {
  verdict = v;
  reason = why;
  times_longer = error_ratio * error_ratio;
}

MethodResult MethodRenders::result(const Method& method, const ReferenceImage& reference,
                                   const std::string& known_bias) const {
  MethodResult result{.method = method};
  result.rounds = costs_;
  const std::vector<double> variances = variances_per_sample(images_, reference.image);
  for (std::size_t i = 0; i < costs_.size(); ++i) result.rounds[i].variance = variances[i];
  result.variance = mean_of(variances);
  result.top_share = top_share(one_sample_images_, reference.image);
  result.mean = mean_of(image_means(images_));
  result.wall = sample_time(costs_, &RoundCost::seconds);
  result.processor = sample_time(costs_, &RoundCost::processor_seconds);
  result.convergence = convergence();
  result.first_image = images_.front();
  judge(result, reference, variances);
  if (!known_bias.empty()) result.decide(Verdict::biased, known_bias);
  return result;
}

} // namespace phlux::bench
