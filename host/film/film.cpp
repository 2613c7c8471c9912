#include "film/film.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace phlux::film {
namespace {

constexpr std::size_t channel_count = 3;

// Unbiased variance of the mean, from the sums S of x and Q of x^2 over n >= 2 samples: that of one sample is
// (Q - S^2/n) / (n - 1), and of the mean 1/n of it. By Cauchy-Schwarz it is >= 0; rounding may leave it just
// below.
double variance_of_mean_in_units(const Pixel& pixel, std::size_t channel) {
  const double n = static_cast<double>(pixel.samples);
  const double mean = pixel.sum[channel] / n;
  return std::max(0.0, (pixel.sum_of_squares[channel] / n - mean * mean) / (n - 1.0));
}

// The same / mean^2, for a mean above 0.
double relative_variance_of_mean(const Pixel& pixel, std::size_t channel) {
  const double mean = pixel.sum[channel] / static_cast<double>(pixel.samples);
  return variance_of_mean_in_units(pixel, channel) / (mean * mean);
}

// Mean of f(pixel, channel) over all channels with a mean above 0 of pixels with two samples or more; 0
// without any.
template<class Function>
double mean_where_not_black(std::span<const Pixel> pixels, Function f) {
  double total = 0.0;
  std::uint64_t count = 0;
  for (const Pixel& pixel : pixels) {
    if (pixel.samples < 2) continue;
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
      if (!(pixel.sum[channel] > 0.0)) continue;
      total += f(pixel, channel);
      ++count;
    }
  }
  return count > 0 ? total / static_cast<double>(count) : 0.0;
}

} // namespace

Film::Film(int width, int height) : width_(width), height_(height) {
  assert(width > 0 && height > 0);
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

void Film::add(std::size_t pixel, const BlockSum& block, std::uint32_t samples) {
  assert(pixel < pixels_.size());
  Pixel& sums = pixels_[pixel];
  for (std::size_t channel = 0; channel < channel_count; ++channel) {
    sums.sum[channel] += static_cast<double>(block.radiance[channel]);
    sums.sum_of_squares[channel] += static_cast<double>(block.radiance_squared[channel]);
  }
  sums.samples += samples;
}

std::array<double, 3> Film::mean(std::size_t pixel) const {
  const Pixel& sums = pixels_[pixel];
  if (sums.samples == 0) return {};
  std::array<double, 3> result;
  for (std::size_t channel = 0; channel < channel_count; ++channel)
    result[channel] = unit_ * sums.sum[channel] / static_cast<double>(sums.samples);
  return result;
}

std::array<double, 3> Film::variance_of_mean(std::size_t pixel) const {
  const Pixel& sums = pixels_[pixel];
  if (sums.samples < 2) return {};
  std::array<double, 3> result;
  for (std::size_t channel = 0; channel < channel_count; ++channel)
    result[channel] = unit_ * unit_ * variance_of_mean_in_units(sums, channel);
  return result;
}

bool Film::has_variance() const {
  return std::ranges::all_of(pixels_, [](const Pixel& pixel) { return pixel.samples >= 2; });
}

double Film::relative_variance() const {
  return mean_where_not_black(pixels_, [](const Pixel& pixel, std::size_t channel) {
    return static_cast<double>(pixel.samples) * relative_variance_of_mean(pixel, channel);
  });
}

double Film::relative_standard_error() const {
  if (!has_variance()) return std::numeric_limits<double>::infinity();
  return mean_where_not_black(pixels_, [](const Pixel& pixel, std::size_t channel) {
    return std::sqrt(relative_variance_of_mean(pixel, channel));
  });
}

double Film::samples_per_pixel() const {
  std::uint64_t samples = 0;
  for (const Pixel& pixel : pixels_) samples += pixel.samples;
  return static_cast<double>(samples) / static_cast<double>(pixels_.size());
}

} // namespace phlux::film
