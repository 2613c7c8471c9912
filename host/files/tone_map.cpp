#include "files/tone_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace phlux::files {
namespace {

constexpr double middle_grey = 0.18;
constexpr float shoulder = 0.6F;            // where the curve leaves the identity
constexpr std::size_t outliers_one_in = 20; // 5% at either end

std::vector<float> lit_luminances(const Image& image) {
  const std::vector<float>& red = image.channels.at("R");
  const std::vector<float>& green = image.channels.at("G");
  const std::vector<float>& blue = image.channels.at("B");
  std::vector<float> luminances;
  luminances.reserve(red.size());
  for (std::size_t pixel = 0; pixel < red.size(); ++pixel) {
    const float luminance =
        0.2126F * red[pixel] + 0.7152F * green[pixel] + 0.0722F * blue[pixel]; // ITU-R BT.709
    if (std::isfinite(luminance) && luminance > 0.0F) luminances.push_back(luminance);
  }
  return luminances;
}

} // namespace

float exposure(const Image& image) {
  std::vector<float> luminances = lit_luminances(image);
  if (luminances.empty()) return 1.0F;
  const auto outliers = static_cast<std::ptrdiff_t>(luminances.size() / outliers_one_in);
  const auto first = luminances.begin() + outliers, last = luminances.end() - outliers;
  std::nth_element(luminances.begin(), first, luminances.end());
  std::nth_element(first, last - 1, luminances.end());
  double sum = 0.0;
  for (auto luminance = first; luminance != last; ++luminance)
    sum += std::log(static_cast<double>(*luminance));
  const double log_average = std::exp(sum / static_cast<double>(last - first));
  return static_cast<float>(std::min(middle_grey / log_average, 1.0 / static_cast<double>(*(last - 1))));
}

float compress_highlights(float value) {
  if (!(value > 0.0F)) return 0.0F;
  if (value <= shoulder) return value;
  return 1.0F - (1.0F - shoulder) * std::exp((shoulder - value) / (1.0F - shoulder));
}

float srgb(float linear) {
  const float clamped = std::clamp(linear, 0.0F, 1.0F);
  return clamped <= 0.0031308F ? 12.92F * clamped : 1.055F * std::pow(clamped, 1.0F / 2.4F) - 0.055F;
}

std::uint8_t srgb_code(float linear) {
  return static_cast<std::uint8_t>(std::lround(255.0F * srgb(linear)));
}

} // namespace phlux::files
