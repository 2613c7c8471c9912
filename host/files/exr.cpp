#include "files/exr.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <ostream>
#include <sstream>

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <xxhash.h>

#include "errors.h"
#include "exr_header.h"
#include "files/output.h"
#include "printable.h"

namespace phlux::files {
namespace {

// OpenEXR's interface to a stream.
class Stream final : public Imf::OStream {
public:
  explicit Stream(std::ostream& to) : Imf::OStream("output"), to_(to) {}
  void write(const char* data, int count) override { to_.write(data, count); }
  std::uint64_t tellp() override { return static_cast<std::uint64_t>(to_.tellp()); }
  void seekp(std::uint64_t position) override { to_.seekp(static_cast<std::streamoff>(position)); }

private:
  std::ostream& to_;
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
    if (range.first < 0 || range.end <= range.first) return {};
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

// Calls use(name, value) for each attribute that is a member of RenderInfo.
template<class Info, class Use>
void for_each_attribute(Info&& info, const Use& use) {
  use("version", info.version);
  use("scene", info.scene);
  use("sceneDigest", info.scene_digest);
  use("choice", info.choice);
  use("samples", info.samples);
  use("device", info.device);
  use("driver", info.driver);
  use("seconds", info.seconds);
  use("clampedShare", info.clamped_share);
  use("missedLight", info.missed_light);
}
constexpr const char *seed_name = "seed", *ranges_name = "sampleRanges", *digest_name = "digest";

void insert_attribute(Imf::Header& header, const char* name, const std::string& value) {
  if (!value.empty()) header.insert(name, Imf::StringAttribute(value));
}
void insert_attribute(Imf::Header& header, const char* name, double value) {
  header.insert(name, Imf::DoubleAttribute(value));
}

void insert_attributes(Imf::Header& header, const RenderInfo& info) {
  for_each_attribute(info,
                     [&](const char* name, const auto& value) { insert_attribute(header, name, value); });
  insert_attribute(header, seed_name, seeds_text(info));
  insert_attribute(header, ranges_name, ranges_text(info.ranges));
  insert_settings(header, info);
  if (info.text("clamp").empty())
    header.erase("clampedShare");
  else
    header.insert("bias", Imf::StringAttribute("clamped"));
}

void find_attribute(const Imf::Header& header, const char* name, std::string& value) {
  if (const auto* attribute = header.findTypedAttribute<Imf::StringAttribute>(name))
    value = attribute->value();
}
void find_attribute(const Imf::Header& header, const char* name, double& value) {
  if (const auto* attribute = header.findTypedAttribute<Imf::DoubleAttribute>(name);
      attribute != nullptr && std::isfinite(attribute->value()))
    value = attribute->value();
}

// A checksum of the attributes, channels and windows that read_exr() uses: a flipped bit in one of them would
// be read as another number of samples, or as the name of another channel. OpenEXR has a checksum of the
// pixels.
std::string digest_of(const Imf::Header& header) {
  std::vector<std::string> names;
  for_each_attribute(RenderInfo(), [&](const char* name, const auto&) { names.emplace_back(name); });
  names.insert(std::ranges::find(names, "device"),
               {seed_name, ranges_name}); // the order is part of the checksum
  for (const settings::Setting& setting : settings::all())
    if (is_stored(setting)) names.push_back(attribute_of(setting.name));
  std::string texts;
  for (const std::string& name : names)
    if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>(name))
      texts += fmt::format("{} {}\n", name, text->value());
    else if (const auto* whole = header.findTypedAttribute<Imf::IntAttribute>(name))
      texts += fmt::format("{} {}\n", name, whole->value());
    else if (const auto* number = header.findTypedAttribute<Imf::DoubleAttribute>(name))
      texts += fmt::format("{} {}\n", name, number->value());
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    texts += fmt::format("{} {}\n", channel.name(), static_cast<int>(channel.channel().type));
  for (const Imath::Box2i& window : {header.dataWindow(), header.displayWindow()})
    texts += fmt::format("{} {} {} {}\n", window.min.x, window.min.y, window.max.x, window.max.y);
  return fmt::format("{} {:016x}", PHLUX_VERSION, XXH3_64bits(texts.data(), texts.size()));
}

// Other versions may have other attributes.
bool is_changed(const Imf::Header& header) {
  std::string digest;
  find_attribute(header, digest_name, digest);
  return digest.starts_with(PHLUX_VERSION " ") && digest != digest_of(header);
}

RenderInfo find_attributes(const Imf::Header& header) {
  RenderInfo info;
  for_each_attribute(info, [&](const char* name, auto& value) { find_attribute(header, name, value); });
  std::string seed, ranges;
  find_attribute(header, seed_name, seed);
  std::from_chars(seed.data(), seed.data() + seed.size(), info.seed);
  find_attribute(header, ranges_name, ranges);
  info.ranges = ranges_in(ranges);
  find_settings(header, info);
  return info;
}

constexpr int largest_side = 1 << 28; // of a whole image

std::vector<const char*> known_channels() {
  std::vector<const char*> names = {reliability_name};
  for (const ChannelNames& three : {radiance_names, variance_names})
    names.insert(names.end(), three.begin(), three.end());
  for (const auto& seven : {first_hit_channels, first_hit_variance_channels})
    names.insert(names.end(), seven.begin(), seven.end());
  return names;
}

Imath::Box2i box(int left, int top, int width, int height) {
  return {Imath::V2i(left, top), Imath::V2i(left + width - 1, top + height - 1)};
}

// The place of a part of an image.
void find_place(const Imf::Header& header, RenderInfo& info) {
  const Imath::Box2i &data = header.dataWindow(), &display = header.displayWindow();
  if (data == display || display.min != Imath::V2i(0, 0) || !display.intersects(data.min) ||
      !display.intersects(data.max) || display.max.x > largest_side || display.max.y > largest_side)
    return;
  info.origin = {data.min.x, data.min.y};
  info.whole = {display.max.x + 1, display.max.y + 1};
}

// Bytes that one level of a tiled file, or one chunk of lines, takes in memory.
double chunk_bytes(const Imf::Header& header, double width) {
  constexpr double most_lines = 256; // of a chunk: DWAB's
  double pixel = 0.0;                // bytes
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    pixel += channel.channel().type == Imf::HALF ? 2.0 : 4.0;
  if (!header.hasTileDescription()) return pixel * width * most_lines;
  const Imf::TileDescription& tile = header.tileDescription();
  return pixel * std::max(width, static_cast<double>(tile.xSize)) * static_cast<double>(tile.ySize);
}

// A damaged header may claim any size. What is allocated for it must be in proportion to the file: Deflate
// packs at most 1032 bytes into one, and floats may be stored as halves.
void check_size(const Imf::Header& header, double width, double height, std::size_t channels,
                double file_bytes) {
  constexpr double always = 1 << 28, per_byte = 2 * 1032;
  const double needed = 4.0 * width * height * static_cast<double>(channels);
  const double most = always + per_byte * file_bytes;
  if (width > 0 && height > 0 && needed <= most && chunk_bytes(header, width) <= most) return;
  throw std::runtime_error(
      fmt::format("it claims {}x{} pixels in a file of {} bytes", width, height, file_bytes));
}

Image read_pixels(Imf::MultiPartInputFile& file, double file_bytes) {
  const Imf::Header& header = file.header(0);
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  std::vector<const char*> names;
  for (const char* name : known_channels()) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    if (channel == nullptr) continue;
    if (channel->xSampling != 1 || channel->ySampling != 1)
      throw std::runtime_error(fmt::format("channel {} is subsampled", name));
    names.push_back(name);
  }
  check_size(header, static_cast<double>(width), static_cast<double>(height), names.size(), file_bytes);

  Image image{.width = static_cast<int>(width),
              .height = static_cast<int>(height),
              .channels = {},
              .info = find_attributes(header)};
  find_place(header, image.info);
  image.info.is_changed = is_changed(header);
  Imf::FrameBuffer frame;
  for (const char* name : names) {
    const auto [entry, _] = image.channels.emplace(name, static_cast<std::size_t>(width * height));
    frame.insert(name, slice_of(entry->second, window));
  }
  Imf::InputPart part(file, 0);
  part.setFrameBuffer(frame);
  part.readPixels(window.min.y, window.max.y);
  return image;
}

} // namespace

NonFinite encode_exr(const Rows& rows, const RenderInfo& info, std::ostream& to) {
  const int strip_lines = std::min(16, rows.height); // 16: those that ZIP compresses together
  const auto width = static_cast<std::size_t>(rows.width),
             strip_values = width * static_cast<std::size_t>(strip_lines);
  std::vector<float> strip(strip_values * rows.channels.size());
  const auto [left, top] = info.origin;
  const Imath::Box2i data = box(left, top, rows.width, rows.height);
  Imf::Header header(info.whole[0] > 0 ? box(0, 0, info.whole[0], info.whole[1]) : data, data);
  header.compression() = Imf::ZIP_COMPRESSION;
  insert_attributes(header, info);
  for (const std::string& name : rows.channels) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  header.insert(digest_name, Imf::StringAttribute(digest_of(header)));

  NonFinite not_finite;
  Stream stream(to);
  Imf::OutputFile file(stream, header); // its destructor writes the table of line offsets
  for (int first = 0; first < rows.height; first += strip_lines) {
    const int lines = std::min(strip_lines, rows.height - first);
    Imf::FrameBuffer frame;
    for (std::size_t channel = 0; channel < rows.channels.size(); ++channel) {
      float* const values = strip.data() + channel * strip_values;
      for (int line = 0; line < lines; ++line)
        rows.fill(first + line, channel, values + static_cast<std::size_t>(line) * width);
      const auto count = std::count_if(values, values + static_cast<std::size_t>(lines) * width,
                                       [](float v) { return !std::isfinite(v); });
      if (count > 0) not_finite[rows.channels[channel]] += static_cast<std::uint64_t>(count);
      const Imath::Box2i window = box(left, top + first, rows.width, lines);
      frame.insert(rows.channels[channel], Imf::Slice::Make(Imf::FLOAT, values, window));
    }
    file.setFrameBuffer(frame);
    file.writePixels(lines);
  }
  return not_finite;
}

std::string encode_exr(const Image& image) {
  std::ostringstream stream(std::ios::binary);
  encode_exr(rows_of(image), image.info, stream);
  return std::move(stream).str();
}

NonFinite write_exr(const std::filesystem::path& file, const Rows& rows, const RenderInfo& info) {
  NonFinite not_finite;
  write_file(file, [&](std::ostream& to) { not_finite = encode_exr(rows, info, to); });
  return not_finite;
}

NonFinite write_exr(const std::filesystem::path& file, const Image& image) {
  return write_exr(file, rows_of(image), image.info);
}

Image read_exr(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code missing;
  const bool regular = std::filesystem::is_regular_file(file, missing); // a pipe might never end
  if (!regular || ::access(name.c_str(), R_OK) != 0)
    throw FileError(fmt::format("{}: cannot be read: {}: an existing OpenEXR image is needed", name,
                                missing   ? missing.message()
                                : regular ? std::strerror(errno)
                                          : "is no file"));
  if (const auto claim = false_claim(file))
    throw FileError(fmt::format("{}: is damaged: {}", name, printable(*claim)));
  try {
    Imf::Header::setMaxImageSize(1 << 28, 1 << 28);
    Imf::Header::setMaxTileSize(1 << 14, 1 << 14);
    Imf::MultiPartInputFile input(name.c_str()); // reads the headers alone
    return read_pixels(input, static_cast<double>(std::filesystem::file_size(file)));
  } catch (const std::exception& error) {
    throw FileError(
        fmt::format("{}: is no OpenEXR image that phlux can read: {}", name, printable(error.what())));
  }
}

} // namespace phlux::files
