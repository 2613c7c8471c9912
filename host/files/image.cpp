#include "files/image.h"

#include <algorithm>
#include <cassert>
#include <memory>

#include "film/reliability.h"

namespace phlux::files {
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

RadianceRow::RadianceRow(const Rows& rows) : rows_(rows) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = std::ranges::find(rows.channels, radiance_names[i]);
    assert(found != rows.channels.end());
    channels_[i] = static_cast<std::size_t>(found - rows.channels.begin());
    values[i].resize(static_cast<std::size_t>(rows.width));
  }
}

void RadianceRow::read(int row) {
  for (std::size_t i = 0; i < 3; ++i) rows_.fill(row, channels_[i], values[i].data());
}

Rows rows_of(const Image& image) {
  Rows rows{.width = image.width, .height = image.height, .channels = {}, .fill = {}};
  std::vector<const float*> values;
  for (const auto& [name, channel] : image.channels) {
    rows.channels.push_back(name);
    values.push_back(channel.data());
  }
  rows.fill = [width = static_cast<std::size_t>(image.width), values](int row, std::size_t channel,
                                                                      float* to) {
    std::copy_n(values[channel] + static_cast<std::size_t>(row) * width, width, to);
  };
  return rows;
}

Rows with_progress(Rows rows, film::Progress progress) {
  rows.fill = [height = rows.height, progress = std::move(progress),
               fill = std::move(rows.fill)](int row, std::size_t channel, float* to) {
    if (channel == 0) progress(static_cast<double>(row) / height);
    fill(row, channel, to);
  };
  return rows;
}

Rows rows_of(const film::Film& film, bool moments, const film::Progress& progress) {
  Rows rows{.width = film.width(), .height = film.height(), .channels = {}, .fill = {}};
  rows.channels.assign(radiance_names.begin(), radiance_names.end());
  std::shared_ptr<const film::ReliabilityMap> reliability;
  if (moments) {
    rows.channels.insert(rows.channels.end(), variance_names.begin(), variance_names.end());
    rows.channels.emplace_back(reliability_name);
    reliability = std::make_shared<film::ReliabilityMap>(film, progress);
  }
  rows.fill = [&film, reliability](int row, std::size_t channel, float* to) {
    const auto width = static_cast<std::size_t>(film.width()), first = static_cast<std::size_t>(row) * width;
    for (std::size_t pixel = first; pixel < first + width; ++pixel)
      *to++ = channel < 3   ? static_cast<float>(film.mean(pixel, channel))
              : channel < 6 ? static_cast<float>(film.variance_of_mean(pixel, channel - 3))
                            : (*reliability)[pixel];
  };
  return rows;
}

void add_first_hits(Rows& rows, const std::vector<film::FirstHit>& hits,
                    const std::vector<std::string>& aov) {
  std::vector<std::size_t> added; // indices into first_hit_channels, those of variances after the others
  const std::size_t before = rows.channels.size(), count = first_hit_channels.size();
  for (std::size_t i = 0; i < 2 * count; ++i) {
    const std::string channel = first_hit_channels[i % count];
    if (std::ranges::find(aov, channel.substr(0, channel.find('.'))) == aov.end()) continue;
    rows.channels.emplace_back(i < count ? channel : first_hit_variance_channels[i - count]);
    added.push_back(i);
  }
  rows.fill = [&hits, before, added, count, width = static_cast<std::size_t>(rows.width),
               others = std::move(rows.fill)](int row, std::size_t channel, float* to) {
    if (channel < before) return others(row, channel, to);
    const bool variance = added[channel - before] >= count;
    const std::size_t value = added[channel - before] % count, first = static_cast<std::size_t>(row) * width;
    for (std::size_t pixel = first; pixel < first + width; ++pixel) {
      const film::FirstHitValues& values = variance ? hits[pixel].variance : hits[pixel].mean;
      *to++ = value < 3 ? values.albedo[value] : value < 6 ? values.normal[value - 3] : values.depth;
    }
  };
}

Image image_of(const film::Film& film, const RenderInfo& info, bool moments) {
  Image image{.width = film.width(), .height = film.height(), .channels = {}, .info = info};
  const Rows rows = rows_of(film, moments);
  for (std::size_t channel = 0; channel < rows.channels.size(); ++channel) {
    std::vector<float>& values = image.channels[rows.channels[channel]];
    values.resize(film.pixels().size());
    for (int row = 0; row < rows.height; ++row)
      rows.fill(row, channel,
                values.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(rows.width));
  }
  return image;
}

} // namespace phlux::files
