#include "images/agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "measure/statistics.h"

namespace phlux::test {
namespace {

constexpr std::size_t channel_count = 3;

double two_sided_p(double z) {
  return std::erfc(z / std::numbers::sqrt2);
}

struct Value {
  double mean = 0.0, variance = 0.0;
};

Value value(const Estimate& image, std::size_t pixel, std::size_t channel) {
  return {image.mean[pixel][channel], image.variance[pixel][channel]};
}

Value mean_over_image(const Estimate& image, std::size_t channel) {
  Value sum;
  const auto pixels = static_cast<double>(image.mean.size());
  for (std::size_t i = 0; i < image.mean.size(); ++i) {
    sum.mean += image.mean[i][channel] / pixels;
    sum.variance += image.variance[i][channel] / pixels / pixels;
  }
  return sum;
}

// Difference of two values beyond rounding, in standard errors; infinite for values that are not finite.
double z_of(const Value& a, const Value& b, double tolerance) {
  const double difference =
      std::abs(a.mean - b.mean) - tolerance * std::max(std::abs(a.mean), std::abs(b.mean));
  if (difference <= 0) return 0;
  const double z = difference / std::sqrt(a.variance + b.variance);
  return std::isfinite(z) ? z : std::numeric_limits<double>::infinity();
}

// The test with the least p-value.
class Worst {
public:
  void add(const Value& a, const Value& b, double tolerance, const std::string& where) {
    const double z = z_of(a, b, tolerance);
    if (z <= z_ && !text_.empty()) return;
    z_ = z;
    text_ =
        fmt::format("worst is {}: {:.6g} +- {:.2g} where {:.6g} +- {:.2g} is expected, z {:.3g}, p {:.3g}",
                    where, a.mean, std::sqrt(a.variance), b.mean, std::sqrt(b.variance), z, two_sided_p(z));
  }
  [[nodiscard]] double z() const { return z_; }
  [[nodiscard]] const std::string& text() const { return text_; }

private:
  double z_ = 0.0;
  std::string text_;
};

} // namespace

Estimate estimate_of(const film::Film& film) {
  Estimate image{film.width(), film.height(), {}, {}};
  for (std::size_t i = 0; i < film.pixels().size(); ++i) {
    image.mean.push_back(film.mean(i));
    image.variance.push_back(film.variance_of_mean(i));
  }
  return image;
}

Estimate closed_form(int width, int height, std::vector<Channels> mean) {
  std::vector<Channels> variance(mean.size(), Channels{});
  return {width, height, std::move(mean), std::move(variance)};
}

Estimate uniform(const film::Film& size_of, const Channels& mean) {
  return closed_form(size_of.width(), size_of.height(), std::vector<Channels>(size_of.pixels().size(), mean));
}

Estimate tiles(const Estimate& image, int side) {
  const int width = image.width / side, height = image.height / side;
  Estimate result =
      closed_form(width, height, std::vector<Channels>(static_cast<std::size_t>(width * height)));
  const double pixels = side * side;
  for (int y = 0; y < height * side; ++y)
    for (int x = 0; x < width * side; ++x) {
      const auto from = static_cast<std::size_t>(y * image.width + x);
      const auto to = static_cast<std::size_t>(y / side * width + x / side);
      for (std::size_t c = 0; c < channel_count; ++c) {
        result.mean[to][c] += image.mean[from][c] / pixels;
        result.variance[to][c] += image.variance[from][c] / pixels / pixels;
      }
    }
  return result;
}

namespace {

Agreement worst_of(const Estimate& image, const Estimate& reference, double tolerance, bool with_mean) {
  if (image.width != reference.width || image.height != reference.height || image.mean.empty())
    return {false, "the images differ in size or are empty"};
  Worst worst;
  for (std::size_t c = 0; c < channel_count; ++c) {
    if (with_mean)
      worst.add(mean_over_image(image, c), mean_over_image(reference, c), tolerance,
                fmt::format("the mean of channel {}", "RGB"[c]));
    for (std::size_t i = 0; i < image.mean.size(); ++i)
      worst.add(value(image, i, c), value(reference, i, c), tolerance,
                fmt::format("channel {} of pixel ({}, {})", "RGB"[c],
                            i % static_cast<std::size_t>(image.width),
                            i / static_cast<std::size_t>(image.width)));
  }
  const double level =
      measure::sidak_limit(false_alarm_rate, (image.mean.size() + (with_mean ? 1 : 0)) * channel_count);
  return {two_sided_p(worst.z()) >= level, fmt::format("{}; p below {:.3g} fails", worst.text(), level)};
}

} // namespace

Agreement agreement(const Estimate& image, const Estimate& reference, double tolerance) {
  return worst_of(image, reference, tolerance, true);
}

Agreement agreement_of_pixels(const Estimate& image, const Estimate& reference, double tolerance) {
  return worst_of(image, reference, tolerance, false);
}

std::vector<Channels> p_of_pixels(const Estimate& image, const Estimate& reference, double tolerance) {
  std::vector<Channels> p(image.mean.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t c = 0; c < channel_count; ++c)
      p[i][c] = two_sided_p(z_of(value(image, i, c), value(reference, i, c), tolerance));
  return p;
}

} // namespace phlux::test
