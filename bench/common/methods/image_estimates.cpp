#include "bench/common/methods/image_estimates.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

#include <boost/math/distributions/students_t.hpp>

namespace phlux::bench {
namespace {

constexpr double squared_floor = 1e-4;   // added to the squared reference, as in files::compare
constexpr std::size_t top_one_in = 1000; // the largest 0.1%

double weight_of(double reference) {
  return 1.0 / (reference * reference + squared_floor);
}

// f(i) is the estimate without repeat i, f(nullopt) that from all.
using LeavesOut = std::function<double(std::optional<std::size_t>)>;
Estimate jackknife(std::size_t repeats, const LeavesOut& f) {
  std::vector<double> values;
  for (std::size_t i = 0; i < repeats; ++i) values.push_back(f(i));
  const double n = static_cast<double>(repeats);
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {f(std::nullopt), std::sqrt((n - 1) / n * squares)};
}

// One channel of one pixel over the repeats, with or without one of them.
struct Values {
  double mean = 0;
  double samples = 0;         // sum over the repeats
  double weighted_square = 0; // sum of n (x - mean)^2
  int count = 0;
};

Values values_of(Repeats repeats, std::optional<std::size_t> left_out, std::size_t value) {
  Values result;
  double sum = 0;
  for (std::size_t i = 0; i < repeats.size(); ++i) {
    if (i == left_out) continue;
    const double samples = repeats[i].samples[value / 3];
    sum += samples * repeats[i].radiance[value];
    result.samples += samples;
    ++result.count;
  }
  result.mean = sum / result.samples;
  for (std::size_t i = 0; i < repeats.size(); ++i) {
    if (i == left_out) continue;
    const double d = repeats[i].radiance[value] - result.mean;
    result.weighted_square += repeats[i].samples[value / 3] * d * d;
  }
  return result;
}

double variance_without(Repeats repeats, const Reference& reference, std::optional<std::size_t> left_out) {
  double total = 0;
  for (std::size_t value = 0; value < reference.size(); ++value) {
    const Values v = values_of(repeats, left_out, value);
    total += weight_of(reference[value]) * v.weighted_square / (v.count - 1);
  }
  return total / static_cast<double>(reference.size());
}

double unexplained_without(Repeats repeats, const Reference& reference, std::optional<std::size_t> left_out) {
  double total = 0;
  for (std::size_t value = 0; value < reference.size(); ++value) {
    const Values v = values_of(repeats, left_out, value);
    const double d = v.mean - reference[value];
    total += weight_of(reference[value]) * (d * d - v.weighted_square / (v.count - 1) / v.samples);
  }
  return total / static_cast<double>(reference.size());
}

} // namespace

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
  for (std::size_t value = 0; value < result.radiance.size(); ++value)
    result.radiance[value] = values_of(repeats, std::nullopt, value).mean;
  for (std::size_t i = 1; i < repeats.size(); ++i)
    for (std::size_t pixel = 0; pixel < result.samples.size(); ++pixel)
      result.samples[pixel] += repeats[i].samples[pixel];
  return result;
}

double relative_mse(const ImageEstimate& image, const Reference& reference) {
  assert(image.radiance.size() == reference.size());
  double total = 0;
  for (std::size_t value = 0; value < reference.size(); ++value) {
    const double d = image.radiance[value] - reference[value];
    total += weight_of(reference[value]) * d * d;
  }
  return total / static_cast<double>(reference.size());
}

Estimate variance_per_sample(Repeats repeats, const Reference& reference) {
  assert(repeats.size() >= 2);
  if (repeats.size() == 2) return {variance_without(repeats, reference, std::nullopt), INFINITY};
  return jackknife(repeats.size(),
                   [&](auto left_out) { return variance_without(repeats, reference, left_out); });
}

Estimate image_mean(Repeats repeats) {
  assert(repeats.size() >= 2);
  std::vector<double> means;
  for (const ImageEstimate& image : repeats)
    means.push_back(std::accumulate(image.radiance.begin(), image.radiance.end(), 0.0) /
                    static_cast<double>(image.radiance.size()));
  return jackknife(means.size(), [&](auto left_out) {
    double sum = 0;
    for (std::size_t i = 0; i < means.size(); ++i) sum += i == left_out ? 0 : means[i];
    return sum / static_cast<double>(means.size() - (left_out ? 1 : 0));
  });
}

Estimate unexplained_mse(Repeats repeats, const Reference& reference) {
  assert(repeats.size() >= 2);
  if (repeats.size() == 2) return {unexplained_without(repeats, reference, std::nullopt), INFINITY};
  return jackknife(repeats.size(),
                   [&](auto left_out) { return unexplained_without(repeats, reference, left_out); });
}

double top_share(Repeats one_sample_images, const Reference& reference) {
  std::vector<double> errors;
  for (const ImageEstimate& image : one_sample_images)
    for (std::size_t pixel = 0; pixel < image.samples.size(); ++pixel) {
      double error = 0;
      for (std::size_t value = 3 * pixel; value < 3 * pixel + 3; ++value) {
        const double d = image.radiance[value] - reference[value];
        error += weight_of(reference[value]) * d * d;
      }
      errors.push_back(error);
    }
  const auto top = static_cast<std::ptrdiff_t>((errors.size() + top_one_in - 1) / top_one_in);
  std::ranges::nth_element(errors, errors.begin() + top - 1, std::greater<>());
  const double all = std::accumulate(errors.begin(), errors.end(), 0.0);
  return all > 0 ? std::accumulate(errors.begin(), errors.begin() + top, 0.0) / all : 0;
}

Estimate log_growth(Repeats many, Repeats few, const Reference& reference) {
  assert(many.size() == few.size() && many.size() >= 3);
  const double a = variance_without(many, reference, std::nullopt),
               b = variance_without(few, reference, std::nullopt);
  if (!(a > 0) || !(b > 0)) return {};
  return jackknife(many.size(), [&](auto left_out) {
    return std::log(variance_without(many, reference, left_out) / variance_without(few, reference, left_out));
  });
}

double p_value(const Estimate& figure, double expected, std::size_t repeats) {
  const double d = std::abs(figure.value - expected);
  if (!(figure.standard_error > 0)) return d > 0 ? 0 : 1;
  if (!std::isfinite(figure.standard_error)) return 1;
  const boost::math::students_t distribution(static_cast<double>(repeats - 1));
  return 2 * boost::math::cdf(boost::math::complement(distribution, d / figure.standard_error));
}

} // namespace phlux::bench
