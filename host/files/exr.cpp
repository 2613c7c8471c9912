#include "files/exr.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <sstream>

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "errors.h"
#include "files/output.h"

namespace phlux::files {
namespace {

class MemoryStream final : public Imf::OStream {
public:
  MemoryStream() : Imf::OStream("memory") {}
  void write(const char* data, int count) override {
    const std::size_t size = static_cast<std::size_t>(count);
    if (position_ + size > bytes.size()) bytes.resize(position_ + size);
    std::memcpy(bytes.data() + position_, data, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::string bytes;

private:
  std::size_t position_ = 0;
};

Imf::Slice slice_of(const std::vector<float>& values, const Imath::Box2i& window) {
  // OpenEXR takes a non-const pointer even for writing a file.
  return Imf::Slice::Make(Imf::FLOAT, const_cast<float*>(values.data()), window);
}

// "0, 7", without repetitions.
std::string seeds_text(const RenderInfo& info) {
  std::vector<std::uint64_t> seeds = {info.seed};
  for (const SampleRange& range : info.ranges)
    if (std::ranges::find(seeds, range.seed) == seeds.end()) seeds.push_back(range.seed);
  return fmt::format("{}", fmt::join(seeds, ", "));
}

// "0:0-64, 7:0-32": seed, first sample, end of the samples.
std::string ranges_text(const std::vector<SampleRange>& ranges) {
  std::string text;
  for (const SampleRange& range : ranges)
    text += fmt::format("{}{}:{}-{}", text.empty() ? "" : ", ", range.seed, range.first, range.end);
  return text;
}

std::vector<SampleRange> ranges_in(const std::string& text) {
  std::vector<SampleRange> ranges;
  std::istringstream stream(text);
  SampleRange range;
  char colon = 0, minus = 0, comma = 0;
  while (stream >> range.seed >> colon >> range.first >> minus >> range.end) {
    ranges.push_back(range);
    stream >> comma;
  }
  return ranges;
}

// "maxDepth" for "max-depth".
std::string attribute_of(const std::string& setting) {
  std::string name;
  for (std::size_t i = 0; i < setting.size(); ++i)
    name += setting[i] == '-' ? static_cast<char>(std::toupper(setting[++i])) : setting[i];
  return name;
}

void insert_settings(Imf::Header& header, const RenderInfo& info) {
  for (const auto& [setting, value] : info.settings) {
    const std::string name = attribute_of(setting);
    if (const auto* text = std::get_if<std::string>(&value))
      header.insert(name, Imf::StringAttribute(*text));
    else if (const auto* whole = std::get_if<std::int64_t>(&value))
      header.insert(name, Imf::IntAttribute(static_cast<int>(*whole)));
    else if (const auto* number = std::get_if<double>(&value))
      header.insert(name, Imf::DoubleAttribute(*number));
  }
}

void find_settings(const Imf::Header& header, RenderInfo& info) {
  for (const settings::Setting& setting : settings::all()) {
    if (!is_stored(setting)) continue;
    const std::string name = attribute_of(setting.name);
    if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>(name))
      info.settings.emplace(setting.name, text->value());
    else if (const auto* whole = header.findTypedAttribute<Imf::IntAttribute>(name))
      info.settings.emplace(setting.name, std::int64_t{whole->value()});
    else if (const auto* number = header.findTypedAttribute<Imf::DoubleAttribute>(name))
      info.settings.emplace(setting.name, number->value());
  }
}

void insert_attributes(Imf::Header& header, const RenderInfo& info) {
  header.insert("version", Imf::StringAttribute(info.version));
  header.insert("scene", Imf::StringAttribute(info.scene));
  header.insert("sceneDigest", Imf::StringAttribute(info.scene_digest));
  header.insert("samples", Imf::DoubleAttribute(info.samples));
  header.insert("seed", Imf::StringAttribute(seeds_text(info)));
  header.insert("sampleRanges", Imf::StringAttribute(ranges_text(info.ranges)));
  header.insert("device", Imf::StringAttribute(info.device));
  header.insert("driver", Imf::StringAttribute(info.driver));
  header.insert("seconds", Imf::DoubleAttribute(info.seconds));
  insert_settings(header, info);
  if (!info.text("clamp").empty()) {
    header.insert("clampedShare", Imf::DoubleAttribute(info.clamped_share));
    header.insert("bias", Imf::StringAttribute("clamped"));
  }
}

void find_attribute(const Imf::Header& header, const char* name, std::string& value) {
  if (const auto* attribute = header.findTypedAttribute<Imf::StringAttribute>(name))
    value = attribute->value();
}
void find_attribute(const Imf::Header& header, const char* name, double& value) {
  if (const auto* attribute = header.findTypedAttribute<Imf::DoubleAttribute>(name))
    value = attribute->value();
}

RenderInfo find_attributes(const Imf::Header& header) {
  RenderInfo info;
  find_attribute(header, "version", info.version);
  find_attribute(header, "scene", info.scene);
  find_attribute(header, "sceneDigest", info.scene_digest);
  find_attribute(header, "samples", info.samples);
  std::string seed;
  find_attribute(header, "seed", seed);
  std::from_chars(seed.data(), seed.data() + seed.size(), info.seed);
  std::string ranges;
  find_attribute(header, "sampleRanges", ranges);
  info.ranges = ranges_in(ranges);
  find_attribute(header, "device", info.device);
  find_attribute(header, "driver", info.driver);
  find_attribute(header, "seconds", info.seconds);
  find_attribute(header, "clampedShare", info.clamped_share);
  find_settings(header, info);
  return info;
}

// A damaged header may claim any size; 2^29 pixels in one channel are 2 GiB.
constexpr std::int64_t most_pixels = std::int64_t{1} << 29;

Image read_pixels(Imf::InputFile& file) {
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width <= 0 || height <= 0 || width > most_pixels / height)
    throw std::runtime_error(fmt::format("an image of {}x{} pixels", width, height));

  Image image{.width = static_cast<int>(width),
              .height = static_cast<int>(height),
              .channels = {},
              .info = find_attributes(header)};
  Imf::FrameBuffer frame;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
      throw std::runtime_error(fmt::format("channel {} is subsampled", channel.name()));
    const auto [entry, _] = image.channels.emplace(channel.name(), static_cast<std::size_t>(width * height));
    frame.insert(channel.name(), slice_of(entry->second, window));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

} // namespace

std::string encode_exr(const Image& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  insert_attributes(header, image.info);
  Imf::FrameBuffer frame;
  for (const auto& [name, values] : image.channels) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, slice_of(values, header.dataWindow()));
  }
  MemoryStream stream;
  {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  } // its destructor writes the table of line offsets
  return std::move(stream.bytes);
}

void write_exr(const std::filesystem::path& file, const Image& image) {
  write_file(file, encode_exr(image));
}

Image read_exr(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (::access(name.c_str(), R_OK) != 0)
    throw FileError(fmt::format("{}: cannot be read: {}: an existing OpenEXR image is needed", name,
                                std::strerror(errno)));
  try {
    Imf::InputFile input(name.c_str());
    return read_pixels(input);
  } catch (const std::exception& error) {
    throw FileError(
        fmt::format("{}: is no OpenEXR image that phlux can read: {}", name, one_line(error.what())));
  }
}

} // namespace phlux::files
