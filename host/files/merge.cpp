#include "files/merge.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "errors.h"

namespace phlux::files {
namespace {

void add_weighted(const Image& image, const ChannelNames& names, double weight,
                  std::array<std::vector<double>, 3>& sums) {
  for (std::size_t channel = 0; channel < names.size(); ++channel) {
    const std::vector<float>& values = image.channels.at(names[channel]);
    sums[channel].resize(values.size());
    for (std::size_t pixel = 0; pixel < values.size(); ++pixel)
      sums[channel][pixel] += weight * static_cast<double>(values[pixel]);
  }
}

void write_channels(const std::array<std::vector<double>, 3>& sums, double factor, const ChannelNames& names,
                    Image& image) {
  for (std::size_t channel = 0; channel < names.size(); ++channel)
    for (const double sum : sums[channel])
      image.channels[names[channel]].push_back(static_cast<float>(factor * sum));
}

// Whether a list of names such as "path, bidir" has this one.
bool contains(const std::string& list, const std::string& name) {
  return (", " + list + ", ").find(", " + name + ", ") != std::string::npos;
}

void append(const std::string& text, std::string& list) {
  if (!contains(list, text)) list += ", " + text;
}

// Keeps the settings that both have.
void append(const std::map<std::string, settings::Value>& more, std::map<std::string, settings::Value>& all) {
  std::erase_if(all, [&](const auto& setting) { return !more.contains(setting.first); });
  for (auto& [name, value] : all) {
    std::string list = settings::text_of(value);
    append(settings::text_of(more.at(name)), list);
    if (more.at(name) != value) value = list;
  }
}

// The value of a setting in `of`, or its default.
settings::Value value_in(const settings::Setting& setting, const RenderInfo& of) {
  const auto found = of.settings.find(setting.name);
  return found == of.settings.end() ? setting.value({}) : found->second;
}

std::string given(const settings::Setting& setting, const RenderInfo& of) {
  const std::string text = settings::text_of(value_in(setting, of));
  return text.empty() ? "without " + settings::quoted(setting.name)
                      : fmt::format("with {} {}", settings::quoted(setting.name), text);
}

std::string bias_of(const RenderInfo& info) {
  for (const settings::Strategy& strategy : settings::strategies)
    if (strategy.biased && contains(info.text("strategy"), strategy.name))
      return fmt::format("was rendered with `strategy` {}, which is biased", strategy.name);
  return "is unbiased";
}

std::string found_light(const RenderInfo& info) {
  return fmt::format("`integrator` {} finds {}", info.text("integrator"),
                     info.missed_light.empty() ? "all light" : "no " + info.missed_light);
}

std::string method_of(const RenderInfo& info) {
  return info.text("integrator") + " " + info.text("strategy");
}

void add_info(const RenderInfo& info, RenderInfo& all) {
  const double samples = all.samples + info.samples;
  all.clamped_share = (all.samples * all.clamped_share + info.samples * info.clamped_share) / samples;
  all.samples = samples;
  all.seconds += info.seconds;
  all.ranges.insert(all.ranges.end(), info.ranges.begin(), info.ranges.end());
  append(info.settings, all.settings);
  append(info.device, all.device);
  append(info.driver, all.driver);
}

} // namespace

void Merger::TakenSamples::add(const std::string& name, const SampleRange& range) {
  const auto after = ranges_.lower_bound({range.seed, range.end});
  if (after != ranges_.begin()) {
    const auto& [key, taken] = *std::prev(after);
    if (key.first == range.seed && taken.end > range.first)
      throw FileError(fmt::format(
          "{}: has samples {} to {} of seed {}, and {} has samples {} to {}: render one of them with "
          "another `seed`, or with `first-sample` {}",
          name, range.first, range.end - 1, range.seed, taken.name, key.second, taken.end - 1, taken.end));
  }
  ranges_.emplace(std::pair(range.seed, range.first), Range{range.end, name});
}

void Merger::check(const Source& source, const Image& image) const {
  const auto& [name, info, variance] = source;
  if (!image.has(radiance_names))
    throw FileError(
        fmt::format("{}: lacks a channel of R, G and B: only images rendered by phlux can be merged", name));
  if (!(info.samples > 0.0) || !std::isfinite(info.samples) || info.ranges.empty())
    throw FileError(fmt::format(
        "{}: does not say which samples it has: only images rendered by phlux can be merged", name));
  if (info.is_changed)
    throw FileError(
        fmt::format("{}: is damaged, or another program has changed it: only images as phlux wrote "
                    "them can be merged",
                    name));
  if (sources_.empty()) return;
  const std::string& first = sources_.front().name;
  const RenderInfo& other = sources_.front().info;
  if (image.width != width_ || image.height != height_)
    throw FileError(fmt::format("{}: is {}x{} pixels, but {} is {}x{}: only images of one size can be merged",
                                name, image.width, image.height, first, width_, height_));
  if (info.scene_digest != other.scene_digest)
    throw FileError(fmt::format("{}: is of another scene ({}) than {} ({}): only images of one scene can be "
                                "merged",
                                name, info.scene, first, other.scene));
  const bool clamped = !info.text("clamp").empty(); // what it removes depends on the method
  for (const settings::Setting& setting : settings::all())
    if ((setting.affects == settings::Affects::expectation ||
         (clamped && setting.affects == settings::Affects::estimate)) &&
        value_in(setting, info) != value_in(setting, other))
      throw FileError(
          fmt::format("{}: was rendered {}, but {} {}: only images of the same light{} can be merged", name,
                      given(setting, info), first, given(setting, other),
                      clamped ? ", and with `clamp` by the same method," : ""));
  if (info.missed_light != other.missed_light)
    throw FileError(fmt::format("{}: {}, but {}: {}: only images of the same light can be merged", name,
                                found_light(info), first, found_light(other)));
  if (bias_of(info) != bias_of(other))
    throw FileError(fmt::format("{}: {}, but {} {}: only images with the same bias, or none, can be merged",
                                name, bias_of(info), first, bias_of(other)));
}

void Merger::add(const std::string& name, const Image& image) {
  const Source source{name, image.info, image.has(variance_names)};
  check(source, image);
  TakenSamples taken = taken_;
  for (const SampleRange& range : image.info.ranges) taken.add(name, range);
  taken_ = std::move(taken);
  width_ = image.width;
  height_ = image.height;
  const double samples = image.info.samples;
  add_weighted(image, radiance_names, samples, radiance_);
  if (source.variance) add_weighted(image, variance_names, samples * samples, variance_);
  for (const auto& [channel, values] : image.channels)
    if (std::ranges::find(radiance_names, channel) == radiance_names.end() &&
        std::ranges::find(variance_names, channel) == variance_names.end() && channel != reliability_name)
      left_out_.insert(channel);
  sources_.push_back(source);
}

Image Merger::result() const {
  Image image{.width = width_, .height = height_, .channels = {}, .info = sources_.front().info};
  for (auto source = sources_.begin() + 1; source != sources_.end(); ++source)
    add_info(source->info, image.info);
  image.info.version = PHLUX_VERSION;
  const double samples = image.info.samples;
  write_channels(radiance_, 1.0 / samples, radiance_names, image);
  if (std::ranges::all_of(sources_, &Source::variance))
    write_channels(variance_, 1.0 / (samples * samples), variance_names, image);
  return image;
}

std::vector<std::string> Merger::notes() const {
  std::vector<std::string> notes;
  const Source& first = sources_.front();
  for (const Source& source : sources_)
    if (method_of(source.info) != method_of(first.info)) {
      notes.push_back(fmt::format(
          "{} is by {}, and {} by {}: the merged image is unbiased, but weights by numbers of samples "
          "are not optimal for methods of different variance",
          source.name, method_of(source.info), first.name, method_of(first.info)));
      break;
    }
  if (!left_out_.empty())
    notes.push_back(fmt::format("the merged image has no channels {}", fmt::join(left_out_, ", ")));
  const auto without = std::ranges::find(sources_, false, &Source::variance);
  if (without != sources_.end() && !std::ranges::none_of(sources_, &Source::variance))
    notes.push_back(fmt::format("{} has no variance channels: the merged image has none: `moments` adds them",
                                without->name));
  return notes;
}

} // namespace phlux::files
