#include "bench/common/methods/image_estimates.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "measure/statistics.h"

namespace phlux::bench {
namespace {

constexpr double squared_floor = 1e-4;   // added to the squared reference, as in files::compare
constexpr std::size_t top_one_in = 1000; // the largest 0.1%
constexpr int filter_reach = 4;          // pixels of Lee's filter about the middle one
constexpr std::size_t pixel_groups = 61; // of unexplained_mse(); prime, so that no group is a column

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<double> weights_of(const std::vector<double>& radiance) {
  std::vector<double> weights;
  weights.reserve(radiance.size());
  for (const double value : radiance) weights.push_back(1.0 / (value * value + squared_floor));
  return weights;
}

// One channel of one pixel over the repeats.
struct Values {
  double mean = 0;
  double samples = 0;          // sum over the repeats
  double variance_of_mean = 0; // sum of n (x - mean)^2 / (R - 1) / samples
};

Values values_of(Repeats repeats, std::size_t value) {
  Values result;
  double sum = 0;
  for (const ImageEstimate& image : repeats) {
    sum += image.samples[value / 3] * image.radiance[value];
    result.samples += image.samples[value / 3];
  }
  result.mean = sum / result.samples;
  double squares = 0;
  for (const ImageEstimate& image : repeats) {
    const double d = image.radiance[value] - result.mean;
    squares += image.samples[value / 3] * d * d;
  }
  result.variance_of_mean = squares / static_cast<double>(repeats.size() - 1) / result.samples;
  return result;
}

// Sums over a rectangle of one channel's values, from sums over all rectangles that begin at the first pixel.
class AreaSums {
public:
  AreaSums(std::size_t width, std::size_t height, const std::function<double(std::size_t pixel)>& value)
      : stride_(width + 1), sums_(stride_ * (height + 1)) {
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x)
        sums_[(y + 1) * stride_ + x + 1] = value(y * width + x) + sums_[y * stride_ + x + 1] +
                                           sums_[(y + 1) * stride_ + x] - sums_[y * stride_ + x];
  }
  [[nodiscard]] double sum(std::size_t x0, std::size_t y0, std::size_t x1, std::size_t y1) const {
    return sums_[y1 * stride_ + x1] - sums_[y0 * stride_ + x1] - sums_[y1 * stride_ + x0] +
           sums_[y0 * stride_ + x0];
  }

private:
  std::size_t stride_;
  std::vector<double> sums_;
};

// Lee's filter: mean + (value - mean) x max(0, 1 - noise / variance), with mean, variance and noise over the
// pixels around.
std::vector<double> denoised(const std::vector<double>& radiance, const std::vector<double>& variance,
                             std::size_t width) {
  const std::size_t height = radiance.size() / 3 / width;
  std::vector<double> result(radiance.size());
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const auto value = [&](std::size_t pixel) { return radiance[3 * pixel + channel]; };
    const double centre = value(0); // keeps cancellation small
    const AreaSums d(width, height, [&](std::size_t p) { return value(p) - centre; });
    const AreaSums d2(width, height, [&](std::size_t p) { return std::pow(value(p) - centre, 2); });
    const AreaSums noise(width, height, [&](std::size_t p) { return variance[3 * p + channel]; });
    for (std::size_t pixel = 0; pixel < width * height; ++pixel) {
      constexpr std::size_t reach = filter_reach;
      const std::size_t x = pixel % width, y = pixel / width;
      const std::size_t x0 = x - std::min(x, reach), y0 = y - std::min(y, reach);
      const std::size_t x1 = std::min(width, x + reach + 1), y1 = std::min(height, y + reach + 1);
      const auto count = static_cast<double>((x1 - x0) * (y1 - y0));
      const double local = d.sum(x0, y0, x1, y1) / count;
      const double spread = d2.sum(x0, y0, x1, y1) / count - local * local;
      const double kept = spread > 0 ? std::max(0.0, 1 - noise.sum(x0, y0, x1, y1) / count / spread) : 0.0;
      result[3 * pixel + channel] = centre + local + kept * (value(pixel) - centre - local);
    }
  }
  return result;
}

} // namespace

double Reference::relmse() const {
  return std::inner_product(weights.begin(), weights.end(), variance.begin(), 0.0) /
         static_cast<double>(weights.size());
}

Reference exact_reference(std::vector<double> radiance) {
  std::vector<double> weights = weights_of(radiance), variance(radiance.size());
  return {std::move(radiance), std::move(variance), std::move(weights)};
}

Reference noisy_reference(std::vector<double> radiance, std::vector<double> variance, std::size_t width) {
  std::vector<double> weights = weights_of(denoised(radiance, variance, width));
  return {std::move(radiance), std::move(variance), std::move(weights)};
}

Reference pooled_reference(Repeats repeats, std::size_t width) {
  assert(repeats.size() >= 2);
  std::vector<double> radiance, variance;
  for (std::size_t value = 0; value < repeats[0].radiance.size(); ++value) {
    const Values v = values_of(repeats, value);
    radiance.push_back(v.mean);
    variance.push_back(v.variance_of_mean);
  }
  return noisy_reference(std::move(radiance), std::move(variance), width);
}

// Pixels of a light-traced image have no samples of their own: each counts the paths per pixel of the image.
ImageEstimate estimate_of(const film::Film& film) {
  ImageEstimate image;
  const std::size_t pixels = film.pixels().size();
  const double of_all = film.samples_per_pixel();
  image.radiance.reserve(3 * pixels);
  image.samples.reserve(pixels);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    for (const double channel : film.mean(pixel)) image.radiance.push_back(channel);
    const std::uint64_t own = film.pixels()[pixel].samples;
    image.samples.push_back(own > 0 ? static_cast<double>(own) : of_all);
  }
  return image;
}

ImageEstimate pooled(Repeats repeats) {
  assert(!repeats.empty());
  ImageEstimate result = repeats[0];
  for (std::size_t value = 0; value < result.radiance.size(); ++value) {
    const Values v = values_of(repeats, value);
    result.radiance[value] = v.mean;
    result.samples[value / 3] = v.samples;
  }
  return result;
}

double relative_mse(const ImageEstimate& image, const Reference& reference) {
  assert(image.radiance.size() == reference.radiance.size());
  double total = 0;
  for (std::size_t value = 0; value < image.radiance.size(); ++value) {
    const double d = image.radiance[value] - reference.radiance[value];
    total += reference.weights[value] * d * d;
  }
  return total / static_cast<double>(image.radiance.size());
}

Estimate mean_of(std::span<const double> values) {
  assert(!values.empty());
  const auto count = static_cast<double>(values.size());
  if (values.size() == 1) return {values[0], INFINITY, 1};
  const double middle = mean(values);
  double squares = 0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  return {middle, std::sqrt(squares / (count - 1) / count), count - 1};
}

std::vector<double> variances_per_sample(Repeats repeats, const Reference& reference) {
  return covariances_per_sample(repeats, repeats, reference);
}

std::vector<double> covariances_per_sample(Repeats a, Repeats b, const Reference& reference) {
  assert(a.size() >= 2 && a.size() == b.size());
  const auto count = static_cast<double>(a.size());
  std::vector<double> covariances(a.size());
  for (std::size_t value = 0; value < reference.radiance.size(); ++value) {
    const double middle_a = values_of(a, value).mean, middle_b = values_of(b, value).mean;
    for (std::size_t i = 0; i < a.size(); ++i)
      covariances[i] += reference.weights[value] * a[i].samples[value / 3] *
                        (a[i].radiance[value] - middle_a) * (b[i].radiance[value] - middle_b);
  }
  for (double& covariance : covariances)
    covariance *= count / (count - 1) / static_cast<double>(reference.radiance.size());
  return covariances;
}

Estimate ratio_of(std::span<const double> a, std::span<const double> b) {
  assert(a.size() >= 2 && a.size() == b.size());
  const auto count = static_cast<double>(a.size());
  const double sum_a = std::accumulate(a.begin(), a.end(), 0.0);
  const double sum_b = std::accumulate(b.begin(), b.end(), 0.0);
  std::vector<double> without; // one of the rounds
  for (std::size_t i = 0; i < a.size(); ++i) without.push_back((sum_a - a[i]) / (sum_b - b[i]));
  double squares = 0;
  for (const double ratio : without) squares += std::pow(ratio - mean(without), 2);
  return {sum_a / sum_b, std::sqrt(squares * (count - 1) / count), count - 1};
}

Estimate mean_log_of(std::span<const Estimate> ratios) {
  const auto count = static_cast<double>(ratios.size());
  double sum = 0, variance = 0;
  for (const Estimate& ratio : ratios) {
    sum += std::log(ratio.value);
    variance += std::pow(ratio.standard_error / ratio.value, 2);
  }
  return {sum / count, std::sqrt(variance) / count, ratios.front().degrees};
}

std::string text_of_mean_log(const Estimate& mean) {
  const double reach = measure::student_t(0.05, mean.degrees) * mean.standard_error;
  return fmt::format("{:.3f} (95%: {:.3f} to {:.3f})", std::exp(mean.value), std::exp(mean.value - reach),
                     std::exp(mean.value + reach));
}

std::vector<double> image_means(Repeats repeats) {
  std::vector<double> means;
  for (const ImageEstimate& image : repeats) means.push_back(mean(image.radiance));
  return means;
}

// A group takes every n-th pixel, so that all groups estimate the same mean.
Estimate unexplained_mse(Repeats repeats, const Reference& reference) {
  assert(repeats.size() >= 2);
  const std::size_t pixels = reference.radiance.size() / 3;
  const std::size_t count = std::min(pixel_groups, pixels);
  std::vector<double> groups(count), sizes(count);
  for (std::size_t value = 0; value < reference.radiance.size(); ++value) {
    const Values v = values_of(repeats, value);
    const double d = v.mean - reference.radiance[value];
    groups[value / 3 % count] +=
        reference.weights[value] * (d * d - v.variance_of_mean - reference.variance[value]);
    ++sizes[value / 3 % count];
  }
  for (std::size_t i = 0; i < count; ++i) groups[i] /= sizes[i];
  return mean_of(groups);
}

double top_share(Repeats one_sample_images, const Reference& reference) {
  std::vector<double> errors;
  for (const ImageEstimate& image : one_sample_images)
    for (std::size_t pixel = 0; pixel < image.samples.size(); ++pixel) {
      double error = 0;
      for (std::size_t value = 3 * pixel; value < 3 * pixel + 3; ++value) {
        const double d = image.radiance[value] - reference.radiance[value];
        error += reference.weights[value] * d * d;
      }
      errors.push_back(error);
    }
  const auto top = static_cast<std::ptrdiff_t>((errors.size() + top_one_in - 1) / top_one_in);
  std::ranges::nth_element(errors, errors.begin() + top - 1, std::greater<>());
  const double all = std::accumulate(errors.begin(), errors.end(), 0.0);
  return all > 0 ? std::accumulate(errors.begin(), errors.begin() + top, 0.0) / all : 0;
}

Estimate log_growth(std::span<const double> many, std::span<const double> few) {
  const Estimate a = mean_of(many), b = mean_of(few);
  if (!(a.value > 0) || !(b.value > 0)) return {};
  const Estimate relative_a{1, a.standard_error / a.value, a.degrees};
  const Estimate relative_b{1, b.standard_error / b.value, b.degrees};
  Estimate growth = difference_of(relative_a, relative_b);
  growth.value = std::log(a.value / b.value);
  return growth;
}

Estimate difference_of(const Estimate& a, const Estimate& b) {
  const double variance_a = a.standard_error * a.standard_error;
  const double variance_b = b.standard_error * b.standard_error, variance = variance_a + variance_b;
  const double quotient = variance_a * variance_a / a.degrees + variance_b * variance_b / b.degrees;
  const double degrees = quotient > 0 && std::isfinite(variance) ? variance * variance / quotient
                                                                 : std::min(a.degrees, b.degrees);
  return {a.value - b.value, std::sqrt(variance), degrees};
}

double p_value(const Estimate& figure, double expected) {
  const double d = std::abs(figure.value - expected);
  if (!(figure.standard_error > 0)) return d > 0 ? 0 : 1;
  return measure::student_p(d / figure.standard_error, figure.degrees);
}

double p_value_above(const Estimate& figure, double expected) {
  const double p = p_value(figure, expected) / 2;
  if (!(figure.standard_error > 0)) return figure.value > expected ? 0 : 1;
  return figure.value > expected ? p : 1 - p;
}

} // namespace phlux::bench
