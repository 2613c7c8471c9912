#include "film/film.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "film/reliability.h"

namespace phlux::film {
namespace {

constexpr std::size_t channel_count = 3;

// Unbiased variance of the mean of n >= 2 values from their sum S and the sum of their squares Q:
// (Q - S^2/n) / (n (n - 1)). Clamped, as rounding can make it negative.
double variance_of_mean_of(double sum, double sum_of_squares, double n) {
  const double mean = sum / n;
  return std::max(0.0, (sum_of_squares / n - mean * mean) / (n - 1.0));
}

} // namespace

void BlockMoments::add(const BlockSum& block, std::uint32_t samples) {
  for (std::size_t channel = 0; channel < channel_count; ++channel) {
    const double sum = block.radiance[channel];
    squares[channel] += sum * sum;
    weighted[channel] += sum * samples;
  }
  squared_samples += static_cast<double>(samples) * samples;
}

Film::Film(int width, int height, Storage storage)
    : width_(width), height_(height), storage_(storage), evidence_(width, height) {
  assert(width > 0 && height > 0);
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), storage);
}

void Film::add(std::size_t pixel, const BlockSum& block, std::uint32_t samples) {
  add(pixel, block, samples, evidence_.tally());
  if (clamp_) clamped_ += block.clamped; // not written by the device otherwise
  count_blocks(1, samples);
}

void Film::count_blocks(std::uint64_t blocks, std::uint32_t samples) {
  blocks_ += blocks;
  own_samples_ += blocks * samples;
  squared_block_samples_ += static_cast<double>(blocks) * samples * samples; // whole numbers: no rounding
  if (splats_.empty()) evidence_.note_growth(this->samples());
}

void Film::add(std::size_t pixel, const BlockSum& block, std::uint32_t samples, Evidence::Tally& tally) {
  assert(pixel < pixels_.size());
  Pixel& sums = pixels_[pixel];
  const double block_sum = std::accumulate(block.radiance, block.radiance + channel_count, 0.0);
  const double mean_before =
      sums.samples > 0
          ? std::accumulate(sums.sum.begin(), sums.sum.end(), 0.0) / static_cast<double>(sums.samples)
          : block_sum / samples; // else every pixel that sees a light would look like an outlier
  sums.samples += samples;
  double square = 0.0;
  for (std::size_t channel = 0; channel < channel_count; ++channel) {
    const double sum = block.radiance[channel], sum_of_squares = block.radiance_squared[channel];
    sums.sum[channel] += sum;
    sums.sum_of_squares[channel] += sum_of_squares;
    const double mean = sums.sum[channel] / static_cast<double>(sums.samples);
    if (!dependent_samples())
      square += std::max(0.0, sum_of_squares - 2.0 * mean * sum + samples * mean * mean);
    else
      square += (sum - samples * mean) * (sum - samples * mean);
  }
  if (dependent_samples()) blocks_of_pixels_[pixel].add(block, samples);
  sums.sum_of_fourths += square * square;
  evidence_.add_block(pixel, square, block_sum, samples, mean_before, tally);
}

void Film::count_splat(std::size_t pixel, double square, double sum, Evidence::Tally& tally) {
  const std::array<double, 3>& splats = splats_[pixel].sum;
  const double before = std::accumulate(splats.begin(), splats.end(), 0.0) - sum;
  evidence_.add_splat(pixel, square, sum, sized_one_in, before, tally);
}

void Film::add_splatting_paths(std::uint64_t paths) {
  splatting_paths_ += paths;
  evidence_.set_splatting_paths(splatting_paths_);
  evidence_.note_growth(samples());
}

void Film::clamp(std::array<double, 3>& value) {
  const double largest = std::ranges::max(value);
  if (!(largest > *clamp_)) return;
  for (double& channel : value) {
    clamped_of_splats_ += channel * (1.0 - *clamp_ / largest);
    channel *= *clamp_ / largest;
  }
}

double Film::clamped_share() const {
  const double clamped = clamped_ + clamped_of_splats_;
  if (!(clamped > 0.0)) return 0.0;
  double left = 0.0;
  for (const Pixel& pixel : pixels()) left += std::accumulate(pixel.sum.begin(), pixel.sum.end(), 0.0);
  for (const Splats& splats : splats_) left += std::accumulate(splats.sum.begin(), splats.sum.end(), 0.0);
  return clamped / (clamped + left);
}

// Blocks of equal length that say as much about a variance as the blocks of a pixel: (sum of lengths)^2 / sum
// of squared lengths.
double Film::equal_blocks_per_pixel() const {
  const auto pixels = static_cast<double>(pixels_.size()), samples = static_cast<double>(own_samples_);
  return samples * samples / (pixels * squared_block_samples_);
}

// Variance of the sum s of squares over the samples of a pixel. From k equal blocks with sums q_b it is
// (sum q_b^2 - s^2 / k) k / (k - 1). One block alone does not show how its squares are spread. The guess is
// s^2 times the share of the pixel's light that a single sample would carry if it had caused all of s: such a
// sample lies sqrt(s n / (n - 1)) above the others. tests/images/coverage_table.cpp measures how good it is.
double Film::variance_of_squares(const Pixel& own, double squares, double mean) const {
  constexpr double least_blocks = 1.9; // two full ones, or a little less
  if (!(squares > 0.0)) return 0.0;
  const double blocks = equal_blocks_per_pixel(), n = static_cast<double>(own.samples);
  if (blocks >= least_blocks)
    return std::max(0.0, own.sum_of_fourths - squares * squares / blocks) * blocks / (blocks - 1.0);
  if (n < 2.0) return 0.0;
  const double light = mean * std::sqrt(channel_count * n * (n - 1.0));
  return squares * squares * std::min(1.0, std::sqrt(squares) / light);
}

Film::Spread Film::spread(std::size_t pixel) const {
  const Pixel& own = pixels_[pixel];
  Spread spread;
  for (std::size_t channel = 0; channel < channel_count; ++channel) {
    spread.mean += mean_in_units(pixel, channel) / channel_count;
    if (own.samples > 0) spread.squares += squared_deviations(pixel, channel);
  }
  spread.variance_of_squares = variance_of_squares(own, spread.squares, spread.mean);
  if (splats_.empty()) return spread;
  // The number of splats is random: the variance of their sum is the sum of their squares.
  const Splats& splats = splats_[pixel];
  spread.squares += std::accumulate(splats.sum_of_squares.begin(), splats.sum_of_squares.end(), 0.0);
  spread.variance_of_squares += splats.sum_of_fourths;
  return spread;
}

double Film::squared_deviations(std::size_t pixel, std::size_t channel) const {
  const Pixel& own = pixels_[pixel];
  const double n = static_cast<double>(own.samples), sum = own.sum[channel];
  if (!dependent_samples()) return std::max(0.0, own.sum_of_squares[channel] - sum * sum / n);
  const BlockMoments& blocks = blocks_of_pixels_[pixel];
  const double mean = sum / n;
  return std::max(0.0, blocks.squares[channel] - 2.0 * mean * blocks.weighted[channel] +
                           mean * mean * blocks.squared_samples);
}

bool Film::has_variance(std::size_t pixel) const {
  const double n = static_cast<double>(pixels_[pixel].samples);
  return dependent_samples() ? n * n > blocks_of_pixels_[pixel].squared_samples : n >= 2.0;
}

// The variance of the mean over a pixel's own samples; 0 with fewer than two independent values. For blocks
// of n_b samples, sum N, with sums S_b and mean m = sum(S_b) / N, it is sum((S_b - n_b m)^2) / (N^2 -
// sum(n_b^2)), unbiased if the variances of the S_b are in proportion to n_b.
double Film::variance_of_own(std::size_t pixel, std::size_t channel) const {
  const Pixel& own = pixels_[pixel];
  const double n = static_cast<double>(own.samples);
  if (!has_variance(pixel)) return 0.0;
  if (!dependent_samples()) return variance_of_mean_of(own.sum[channel], own.sum_of_squares[channel], n);
  return squared_deviations(pixel, channel) / (n * n - blocks_of_pixels_[pixel].squared_samples);
}

double Film::splatting_paths_per_pixel() const {
  return static_cast<double>(splatting_paths_) / static_cast<double>(pixels_.size());
}

double Film::mean_in_units(std::size_t pixel, std::size_t channel) const {
  const Pixel& own = pixels_[pixel];
  double mean = own.samples > 0 ? own.sum[channel] / static_cast<double>(own.samples) : 0.0;
  if (!splats_.empty() && splatting_paths_ > 0)
    mean += splats_[pixel].sum[channel] / splatting_paths_per_pixel();
  return mean;
}

// Splats of a path onto its own pixel count as samples of that pixel. The two parts are then of different
// paths, and their variances add. While pixels differ in their number of samples, the mean of such splats is
// off by up to one part in the number of pixels.
double Film::variance_in_units(std::size_t pixel, std::size_t channel) const {
  const Pixel& own = pixels_[pixel];
  const double n = static_cast<double>(own.samples);
  double variance = variance_of_own(pixel, channel);
  const double others = static_cast<double>(splatting_paths_) - n;
  if (!splats_.empty() && others >= 2.0) {
    const Splats& splats = splats_[pixel];
    const double scale = others / splatting_paths_per_pixel();
    variance +=
        scale * scale * variance_of_mean_of(splats.sum[channel], splats.sum_of_squares[channel], others);
  }
  return variance;
}

std::array<double, 3> Film::mean(std::size_t pixel) const {
  std::array<double, 3> result;
  for (std::size_t channel = 0; channel < channel_count; ++channel) result[channel] = mean(pixel, channel);
  return result;
}

std::array<double, 3> Film::variance_of_mean(std::size_t pixel) const {
  std::array<double, 3> result;
  for (std::size_t channel = 0; channel < channel_count; ++channel)
    result[channel] = variance_of_mean(pixel, channel);
  return result;
}

std::vector<std::array<double, 3>>
Film::technique_image(const std::vector<std::array<double, 3>>& sums) const {
  std::vector<std::array<double, 3>> image = sums;
  const double factor = splatting_paths_ > 0 ? unit_ / splatting_paths_per_pixel() : 0.0;
  for (std::array<double, 3>& pixel : image)
    for (double& value : pixel) value *= factor;
  return image;
}

std::string Film::contradiction(const std::function<std::uint64_t(std::size_t pixel)>& samples_of,
                                std::uint64_t paths) const {
  const auto sound =
      [](const auto& sums) { // infinity may come of overflow, but neither NaN nor a negative square
        return !std::ranges::any_of(sums.sum, [](double sum) { return std::isnan(sum); }) &&
               std::ranges::all_of(sums.sum_of_squares, [](double square) { return square >= 0.0; }) &&
               sums.sum_of_fourths >= 0.0;
      };
  std::uint64_t samples = 0;
  for (std::size_t pixel = 0; pixel < pixels_.size(); ++pixel) {
    samples += pixels_[pixel].samples;
    if (pixels_[pixel].samples != samples_of(pixel)) return "numbers of samples";
    if (!sound(pixels_[pixel])) return "sums of samples";
  }
  for (std::size_t pixel = 0; pixel < blocks_of_pixels_.size(); ++pixel) {
    const double n = static_cast<double>(pixels_[pixel].samples);
    const BlockMoments& blocks = blocks_of_pixels_[pixel];
    const bool sums_are_sound =
        std::ranges::all_of(blocks.squares, [](double square) { return square >= 0.0; }) &&
        !std::ranges::any_of(blocks.weighted, [](double sum) { return std::isnan(sum); });
    if (!(blocks.squared_samples >= n && blocks.squared_samples <= n * n) || !sums_are_sound)
      return "sums of point sets";
  }
  if (samples != own_samples_ || splatting_paths_ != paths || blocks_ > samples ||
      (samples > 0) != (blocks_ > 0))
    return "numbers of paths";
  if (!std::ranges::all_of(splats_, sound)) return "sums of splats";
  if (!(unit_ > 0.0) || !std::isfinite(unit_ + squared_block_samples_ + clamped_ + clamped_of_splats_) ||
      squared_block_samples_ < static_cast<double>(samples) || clamped_ < 0.0 || clamped_of_splats_ < 0.0)
    return "sums over the image";
  if (!evidence_.is_sound()) return "contributions by size";
  if (techniques_)
    for (const auto& [technique, sums] : techniques_->sums()) {
      const bool known = technique.light_vertices >= 0 && technique.eye_vertices >= 0 &&
                         technique.edges() >= 1 && technique.edges() <= most_technique_edges;
      for (const auto* image : {&sums.weighted, &sums.unweighted})
        for (const std::array<double, 3>& pixel : *image)
          if (!known || std::isnan(pixel[0]) || std::isnan(pixel[1]) || std::isnan(pixel[2]))
            return "contributions of techniques";
    }
  return {};
}

bool Film::has_variance() const {
  if (own_samples_ == 0) return splatting_paths_per_pixel() >= 2.0;
  std::size_t known = 0;
  while (known < pixels_.size() && has_variance(known)) ++known;
  return known == pixels_.size();
}

void Film::report(const Progress& progress, std::size_t pixel) const {
  constexpr std::size_t pixels_between_reports = std::size_t{1} << 16;
  if (progress && pixel % pixels_between_reports == 0)
    progress(static_cast<double>(pixel) / static_cast<double>(pixels_.size()));
}

double Film::least_scale() const {
  if (!signed_) return 0.0;
  double sum = 0.0;
  for (std::size_t pixel = 0; pixel < pixels_.size(); ++pixel)
    for (std::size_t channel = 0; channel < channel_count; ++channel) sum += mean_in_units(pixel, channel);
  return std::max(0.0, sum / (channel_count * static_cast<double>(pixels_.size())));
}

Film::RelativeError Film::relative_error(const Progress& progress) const {
  const double least = least_scale();
  double variances = 0.0, errors = 0.0;
  std::uint64_t count = 0; // of channels that are not black
  std::size_t known = 0;   // pixels of whose own samples there are enough
  for (std::size_t pixel = 0; pixel < pixels_.size(); ++pixel) {
    report(progress, pixel);
    if (has_variance(pixel))
      ++known;
    else if (splatting_paths_ < 2)
      continue;
    const std::uint64_t own = pixels_[pixel].samples;
    const double samples = own > 0 ? static_cast<double>(own) : splatting_paths_per_pixel();
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
      const double radiance = mean_in_units(pixel, channel), mean = std::max(radiance, least);
      if (radiance == 0.0 || !(mean > 0.0)) continue;
      const double variance = variance_in_units(pixel, channel);
      variances += samples * variance / (mean * mean);
      errors += std::sqrt(variance) / mean;
      ++count;
    }
  }
  RelativeError error;
  const double channels = static_cast<double>(std::max<std::uint64_t>(count, 1));
  error.variance = variances / channels;
  if (own_samples_ > 0 ? known == pixels_.size() : splatting_paths_per_pixel() >= 2.0)
    error.standard_error = errors / channels;
  return error;
}

double Film::samples_per_pixel() const {
  if (own_samples_ == 0) return splatting_paths_per_pixel();
  return static_cast<double>(own_samples_) / static_cast<double>(pixels_.size());
}

} // namespace phlux::film
