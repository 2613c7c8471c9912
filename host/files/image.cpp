#include "files/image.h"

#include <algorithm>

#include "film/reliability.h"

namespace phlux::files {
namespace {

template<class Function>
void add_channels(Image& image, const ChannelNames& names, std::size_t pixels, Function values_of) {
  std::array<float*, 3> channels{};
  for (std::size_t channel = 0; channel < names.size(); ++channel)
    channels[channel] = image.channels.emplace(names[channel], pixels).first->second.data();
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    const std::array<double, 3> values = values_of(pixel);
    for (std::size_t channel = 0; channel < names.size(); ++channel)
      channels[channel][pixel] = static_cast<float>(values[channel]);
  }
}

} // namespace

std::string RenderInfo::text(const std::string& setting) const {
  const auto found = settings.find(setting);
  return found == settings.end() ? std::string() : settings::text_of(found->second);
}

bool Image::has(const ChannelNames& names) const {
  return std::ranges::all_of(names, [&](const char* name) { return channels.contains(name); });
}

bool is_stored(const settings::Setting& setting) {
  return setting.affects == settings::Affects::expectation || setting.affects == settings::Affects::estimate;
}

std::map<std::string, settings::Value> stored(const settings::Settings& settings) {
  std::map<std::string, settings::Value> values;
  for (const settings::Setting& setting : settings::all())
    if (const settings::Value value = setting.value(settings);
        is_stored(setting) && value != settings::Value())
      values.emplace(setting.name, value);
  return values;
}

Image image_of(const film::Film& film, const RenderInfo& info, bool moments) {
  Image image{.width = film.width(), .height = film.height(), .channels = {}, .info = info};
  const std::size_t pixels = film.pixels().size();
  add_channels(image, radiance_names, pixels, [&](std::size_t pixel) { return film.mean(pixel); });
  if (moments) {
    add_channels(image, variance_names, pixels,
                 [&](std::size_t pixel) { return film.variance_of_mean(pixel); });
    image.channels.emplace("reliability", film::reliability_map(film));
  }
  return image;
}

} // namespace phlux::files
