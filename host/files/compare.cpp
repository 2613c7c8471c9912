#include "files/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "errors.h"
#include "files/tone_map.h"

namespace phlux::files {
namespace {

constexpr double rounding_share = 0x1p-16; // 256 x 2^-24: a float32 sum of 256 equal samples
constexpr std::size_t trim_one_in = 1000;

using Channels = std::array<const std::vector<float>*, 3>;

Channels channels_of(const Image& image, const std::array<const char*, 3>& names, const std::string& file) {
  Channels channels{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = image.channels.find(names[i]);
    if (found == image.channels.end())
      throw FileError(fmt::format("{}: has no channel {}: R, G and B are compared", file, names[i]));
    channels[i] = &found->second;
  }
  return channels;
}

std::uint64_t nonfinite_values(const std::vector<Channels>& groups, std::size_t pixel) {
  std::uint64_t count = 0;
  for (const Channels& channels : groups)
    for (const std::vector<float>* channel : channels) count += std::isfinite((*channel)[pixel]) ? 0 : 1;
  return count;
}

// Sums over the finite pixels.
struct Sums {
  float exposure = 1.0F;
  std::vector<double> relative_squares; // per pixel, mean over channels
  std::array<double, 3> a{}, b{};
  double squares = 0.0, screen_squares = 0.0;
  double max_z = 0.0;
  std::uint64_t z_over_3 = 0;

  void add_radiance(const Channels& of_a, const Channels& of_b, std::size_t pixel) {
    double relative = 0.0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double value_a = (*of_a[channel])[pixel], value_b = (*of_b[channel])[pixel];
      const double square = (value_a - value_b) * (value_a - value_b);
      a[channel] += value_a;
      b[channel] += value_b;
      squares += square;
      relative += square / (value_b * value_b + relmse_offset) / 3.0;
      const double on_screen = screen_value((*of_a[channel])[pixel]) - screen_value((*of_b[channel])[pixel]);
      screen_squares += on_screen * on_screen;
    }
    relative_squares.push_back(relative);
  }

  // In [0, 1], as a picture shows it.
  [[nodiscard]] double screen_value(float radiance) const {
    return srgb(compress_highlights(exposure * radiance));
  }

  // groups: radiance of a and b, variance of a and b
  void add_z(const std::vector<Channels>& groups, std::size_t pixel) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double value_a = (*groups[0][channel])[pixel], value_b = (*groups[1][channel])[pixel];
      const double variance = // of other programs it may be below 0, which must not hide a difference
          std::max(0.0, static_cast<double>((*groups[2][channel])[pixel]) + (*groups[3][channel])[pixel]);
      const double rounding = rounding_share * std::max(std::abs(value_a), std::abs(value_b));
      const double difference = std::abs(value_a - value_b);
      const double z = difference == 0.0 ? 0.0 : difference / std::sqrt(variance + rounding * rounding);
      max_z = std::max(max_z, z);
      z_over_3 += z > 3.0 ? 1 : 0;
    }
  }
};

double mean(std::vector<double>::const_iterator first, std::vector<double>::const_iterator last) {
  return std::accumulate(first, last, 0.0) / static_cast<double>(last - first);
}

Comparison figures(Sums& sums, bool with_z) {
  Comparison result;
  const std::size_t pixels = sums.relative_squares.size();
  const double values = 3.0 * static_cast<double>(pixels); // 0: every mean is 0/0
  for (std::size_t channel = 0; channel < 3; ++channel) {
    result.mean_a_rgb[channel] = sums.a[channel] / static_cast<double>(pixels);
    result.mean_b_rgb[channel] = sums.b[channel] / static_cast<double>(pixels);
  }
  result.mean_a = (sums.a[0] + sums.a[1] + sums.a[2]) / values;
  result.mean_b = (sums.b[0] + sums.b[1] + sums.b[2]) / values;
  result.mean_ratio = result.mean_a / result.mean_b;
  result.mean_error = std::abs(result.mean_ratio - 1.0);
  result.rmse = std::sqrt(sums.squares / values);
  std::ranges::sort(sums.relative_squares);
  const auto trimmed = static_cast<std::ptrdiff_t>(pixels / trim_one_in);
  result.relmse = mean(sums.relative_squares.cbegin(), sums.relative_squares.cend());
  result.relmse_trimmed = mean(sums.relative_squares.cbegin(), sums.relative_squares.cend() - trimmed);
  result.psnr = -10.0 * std::log10(sums.screen_squares / values);
  if (with_z) {
    result.max_z = pixels > 0 ? sums.max_z : std::numeric_limits<double>::quiet_NaN();
    result.z_share_over_3 = static_cast<double>(sums.z_over_3) / values;
  }
  return result;
}

} // namespace

Comparison compare(const Image& a, const Image& b, const std::string& name_a, const std::string& name_b) {
  if (a.width != b.width || a.height != b.height)
    throw FileError(
        fmt::format("{}: is {}x{} pixels, but {} is {}x{}: only images of one size can be compared", name_a,
                    a.width, a.height, name_b, b.width, b.height));
  if (a.info.origin != b.info.origin || a.info.whole != b.info.whole)
    throw FileError(fmt::format("{} and {}: are different parts of an image (`crop`), which have no pixels "
                                "in common places: only images of one part can be compared",
                                name_a, name_b));
  std::vector<Channels> groups = {channels_of(a, radiance_names, name_a),
                                  channels_of(b, radiance_names, name_b)};
  const bool with_z = a.has(variance_names) && b.has(variance_names);
  if (with_z) {
    groups.push_back(channels_of(a, variance_names, name_a));
    groups.push_back(channels_of(b, variance_names, name_b));
  }
  Sums sums;
  sums.exposure = exposure(b);
  std::uint64_t nonfinite = 0;
  for (std::size_t pixel = 0; pixel < groups[0][0]->size(); ++pixel) {
    const std::uint64_t of_pixel = nonfinite_values(groups, pixel);
    nonfinite += of_pixel;
    if (of_pixel > 0) continue;
    sums.add_radiance(groups[0], groups[1], pixel);
    if (with_z) sums.add_z(groups, pixel);
  }
  Comparison result = figures(sums, with_z);
  result.nonfinite = nonfinite;
  return result;
}

nlohmann::ordered_json to_json(const Comparison& comparison) {
  nlohmann::ordered_json json = {{"mean_a", comparison.mean_a},
                                 {"mean_a_rgb", comparison.mean_a_rgb},
                                 {"mean_b", comparison.mean_b},
                                 {"mean_b_rgb", comparison.mean_b_rgb},
                                 {"mean_ratio", comparison.mean_ratio},
                                 {"mean_error", comparison.mean_error},
                                 {"rmse", comparison.rmse},
                                 {"relmse", comparison.relmse},
                                 {"relmse_trimmed", comparison.relmse_trimmed},
                                 {"psnr", comparison.psnr}};
  if (comparison.max_z) json["max_z"] = *comparison.max_z;
  if (comparison.z_share_over_3) json["z_share_over_3"] = *comparison.z_share_over_3;
  json["nonfinite"] = comparison.nonfinite;
  return json;
}

} // namespace phlux::files
