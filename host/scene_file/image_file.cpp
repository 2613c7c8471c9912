#include "scene_file/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>

#include <fmt/format.h>
#define STBI_NO_STDIO
#include <stb/stb_image.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include "errors.h"
#include "exr_header.h"

namespace phlux::scene_file {

namespace {

constexpr const char* formats = "a PNG, JPEG, BMP, TGA, HDR or OpenEXR image of at most 16384x16384 pixels";

/// A valid file has at least one byte for so many pixels: PNG's compression, the best of those that
/// stb_image reads, ends at 1032 bytes, which may be 8256 pixels.
constexpr std::uint64_t most_pixels_of_byte = 1 << 16;

void check_size(const Location& file, std::uint64_t file_bytes, std::int64_t width, std::int64_t height) {
  if (width <= 0 || height <= 0)
    fail(file, fmt::format("an image of {}x{} pixels", width, height), "at least one pixel");
  const auto columns = static_cast<std::uint64_t>(width), rows = static_cast<std::uint64_t>(height);
  if (columns > most_image_pixels / rows)
    fail(file, fmt::format("an image of {}x{} pixels is too large", width, height),
         fmt::format("at most {} pixels, as 16384x16384 has", most_image_pixels));
  if (columns * rows > most_pixels_of_byte * file_bytes)
    fail(file, fmt::format("damaged: it claims {}x{} pixels in {} bytes", width, height, file_bytes),
         formats);
}

/// The file as stb_image reads it. It asks for bytes beyond the end of a file only if that is cut short.
class Source {
public:
  explicit Source(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return; // opening a pipe may block
    size_ = std::filesystem::file_size(file, error);
    stream_.open(file, std::ios::binary);
    readable_ = stream_.good() && !error;
  }

  [[nodiscard]] bool readable() const { return readable_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] bool cut_short() const { return cut_short_; }
  /// Those from `offset` on, fewer at the end of the file.
  [[nodiscard]] std::string bytes(std::uint64_t offset, std::size_t count) {
    std::string bytes(count, '\0');
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(stream_.gcount()));
    return bytes;
  }

  /// A function of stb_image from the beginning of the file.
  template<class Function, class... Arguments>
  auto call(Function function, Arguments... arguments) {
    static constexpr stbi_io_callbacks callbacks{read, skip, at_end};
    rewind();
    return function(&callbacks, this, arguments...);
  }

private:
  static constexpr int buffer_bytes = 128; ///< of stb_image, which asks for as many and takes fewer

  void rewind() {
    stream_.clear();
    stream_.seekg(0);
    cut_short_ = false;
  }
  static int read(void* user, char* data, int size) {
    auto& source = *static_cast<Source*>(user);
    source.stream_.read(data, size);
    const auto count = static_cast<int>(source.stream_.gcount());
    source.cut_short_ |= count == 0 || (count < size && size != buffer_bytes);
    return count;
  }
  static void skip(void* user, int count) {
    auto& source = *static_cast<Source*>(user);
    source.stream_.clear();
    source.stream_.seekg(count, std::ios::cur);
  }
  static int at_end(void* user) {
    auto& source = *static_cast<Source*>(user);
    return source.stream_.peek() == std::ifstream::traits_type::eof() ? 1 : 0;
  }

  std::ifstream stream_;
  std::uint64_t size_ = 0;
  bool readable_ = false, cut_short_ = false;
};

void check_finite(const Location& file, const ImageFile& image) {
  const auto wrong = std::ranges::find_if(image.floats, [](float value) { return !std::isfinite(value); });
  if (wrong == image.floats.end()) return;
  const auto pixel = (wrong - image.floats.begin()) / 3;
  fail(file, fmt::format("pixel ({}, {}) is not finite", pixel % image.width, pixel / image.width),
       "finite numbers");
}

template<class Value>
using Pixels = std::unique_ptr<Value, void (*)(void*)>;

/// The pixels that a function of stb_image decodes; R, G, B and, if `alpha`, a fourth channel.
template<class Value, class Load>
Pixels<Value> decoded(const Location& file, Source& source, Load load, bool alpha) {
  int width{}, height{}, channels{};
  Pixels<Value> pixels(source.call(load, &width, &height, &channels, alpha ? 4 : 3), stbi_image_free);
  if (pixels && !source.cut_short()) return pixels;
  fail(file,
       source.cut_short() ? "the image is cut short"
                          : fmt::format("the image is damaged ({})", stbi_failure_reason()),
       "the whole file");
}

/// Checks that the chunks of a PNG file end within the file: stb_image allocates the length that a chunk
/// states before it reads the chunk.
void check_chunks(const Location& file, Source& source) {
  if (source.bytes(0, 8) != "\x89PNG\r\n\x1a\n") return;
  constexpr std::uint64_t rest = 12; // of a chunk: its length, type and checksum
  for (std::uint64_t at = 8; at < source.size();) {
    const std::string head = source.bytes(at, 8);
    if (head.size() == 8 && head.substr(4) == "IEND") return;
    std::uint64_t chunk = rest;
    for (std::size_t i = 0; i < 4 && i < head.size(); ++i)
      chunk += std::uint64_t{static_cast<unsigned char>(head[i])} << (24 - 8 * i);
    if (head.size() < 8 || chunk > source.size() - at) fail(file, "the image is cut short", "the whole file");
    at += chunk;
  }
}

/// Of images that have none.
[[noreturn]] void fail_without_alpha(const Location& file) {
  fail(file, "the image has no alpha", "an image with alpha, or one of its other channels");
}

ImageFile read_by_stb(const Location& file, Source& source, bool alpha) {
  ImageFile image;
  int channels{};
  if (source.call(stbi_info_from_callbacks, &image.width, &image.height, &channels) == 0)
    fail(file, fmt::format("not an image that can be read ({})", stbi_failure_reason()), formats);
  check_size(file, source.size(), image.width, image.height);
  check_chunks(file, source);
  const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (alpha && channels != 2 && channels != 4) fail_without_alpha(file);
  if (source.call(stbi_is_hdr_from_callbacks) != 0) {
    const auto values = decoded<float>(file, source, stbi_loadf_from_callbacks, false);
    image.floats.assign(values.get(), values.get() + 3 * pixels);
    check_finite(file, image);
    return image;
  }
  image.is_encoded = !alpha;
  if (source.call(stbi_is_16_bit_from_callbacks) != 0) {
    const auto values = decoded<stbi_us>(file, source, stbi_load_16_from_callbacks, alpha);
    image.floats.resize(3 * pixels);
    for (std::size_t i = 0; i < image.floats.size(); ++i)
      image.floats[i] =
          static_cast<float>(values.get()[alpha ? i / 3 * 4 + 3 : i]) / std::numeric_limits<stbi_us>::max();
    return image;
  }
  const auto values = decoded<stbi_uc>(file, source, stbi_load_from_callbacks, true);
  image.bytes.assign(values.get(), values.get() + 4 * pixels);
  for (std::size_t i = 3; i < image.bytes.size(); i += 4) {
    if (alpha) image.bytes[i - 3] = image.bytes[i - 2] = image.bytes[i - 1] = image.bytes[i];
    image.bytes[i] = 255;
  }
  return image;
}

/// The channels of a colour: R, G and B, or Y for each; or A for each.
std::array<const char*, 3> channels_of(const Location& file, const Imf::ChannelList& channels, bool alpha) {
  const auto has = [&](const char* name) { return channels.findChannel(name) != nullptr; };
  if (alpha && !has("A")) fail_without_alpha(file);
  if (alpha) return {"A", "A", "A"};
  if (has("R") && has("G") && has("B")) return {"R", "G", "B"};
  if (has("Y") && !has("RY")) return {"Y", "Y", "Y"};
  std::string names;
  for (auto each = channels.begin(); each != channels.end(); ++each)
    names += (names.empty() ? "" : ", ") + std::string(each.name());
  fail(file, "an image of channels " + names, "channels R, G and B, or Y alone");
}

ImageFile pixels_of(const Location& where, std::uint64_t file_bytes, Imf::InputFile& input, bool alpha) {
  const Imath::Box2i window = input.header().dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  check_size(where, file_bytes, width, height);
  const auto names = channels_of(where, input.header().channels(), alpha);
  ImageFile image{static_cast<int>(width), static_cast<int>(height), {}, {}, false};
  image.floats.resize(static_cast<std::size_t>(3 * width * height));
  Imf::FrameBuffer frame;
  const bool grey = names[0] == names[1];
  for (std::size_t i = 0; i < (grey ? 1 : 3); ++i) {
    const Imf::Channel& channel = input.header().channels()[names[i]];
    if (channel.xSampling != 1 || channel.ySampling != 1)
      fail(where, fmt::format("channel {} is subsampled", names[i]), "a value for every pixel");
    frame.insert(names[i], Imf::Slice::Make(Imf::FLOAT, image.floats.data() + i, window, 3 * sizeof(float),
                                            3 * sizeof(float) * static_cast<std::size_t>(width)));
  }
  input.setFrameBuffer(frame);
  input.readPixels(window.min.y, window.max.y);
  for (std::size_t i = 0; grey && i < image.floats.size(); i += 3)
    image.floats[i + 1] = image.floats[i + 2] = image.floats[i];
  return image;
}

ImageFile read_exr(const std::filesystem::path& file, const Location& where, std::uint64_t file_bytes,
                   bool alpha) {
  ImageFile image;
  std::string damage;
  if (const auto claim = false_claim(file)) fail(where, "damaged: " + *claim, formats);
  try {
    Imf::InputFile input(file.string().c_str());
    image = pixels_of(where, file_bytes, input, alpha);
  } catch (const SceneError&) {
    throw;
  } catch (const std::exception& error) {
    damage = error.what();
  }
  std::ranges::replace(damage, '\n', ' ');
  if (!damage.empty()) fail(where, "the image is damaged or cut short (" + damage + ")", "the whole file");
  check_finite(where, image);
  return image;
}

} // namespace

void fail_in_image(const std::filesystem::path& file, const Location& named_at, const std::string& wrong,
                   const std::string& right) {
  fail(named_at, "image file '" + file.string() + "': " + wrong, right);
}

ImageFile read_image(const std::filesystem::path& file, const Location& named_at, ImageChannels channels) {
  const bool alpha = channels == ImageChannels::alpha;
  const Location where{std::make_shared<const std::string>(file.string()), 0};
  Source source(file);
  if (!source.readable())
    fail(named_at, "image file '" + file.string() + "' cannot be read",
         "an existing file, named relative to the scene's folder");
  try {
    if (source.bytes(0, 4) == "\x76\x2f\x31\x01") return read_exr(file, where, source.size(), alpha);
    return read_by_stb(where, source, alpha);
  } catch (const LocatedError& error) {
    fail_in_image(file, named_at, error.wrong, error.right);
  }
}

} // namespace phlux::scene_file
