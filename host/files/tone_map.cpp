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

std::vector<float> lit_luminances(const Rows& rows) {
  constexpr std::size_t most = std::size_t{1} << 22;
  const auto width = static_cast<std::size_t>(rows.width),
             pixels = width * static_cast<std::size_t>(rows.height);
  const std::size_t step = (pixels - 1) / most | 1; // odd, so that it does not divide common widths
  RadianceRow radiance(rows);
  const auto& [red, green, blue] = radiance.values;
  std::vector<float> luminances;
  luminances.reserve(pixels / step + 1);
  std::size_t pixel = 0;
  for (int y = 0; y < rows.height; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * width;
    if (pixel >= first + width) continue;
    radiance.read(y);
    for (; pixel < first + width; pixel += step) {
      const std::size_t x = pixel - first;
      const float luminance = 0.2126F * red[x] + 0.7152F * green[x] + 0.0722F * blue[x]; // ITU-R BT.709
      if (std::isfinite(luminance) && luminance > 0.0F) luminances.push_back(luminance);
    }
  }
  return luminances;
}

} // namespace

float exposure(const Rows& rows) {
  std::vector<float> luminances = lit_luminances(rows);
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
