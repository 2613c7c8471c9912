#include "scene_file/textures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene_file/color.h"
#include "scene_file/image_file.h"
#include "scene_file/properties.h"

namespace phlux::scene_file {

namespace {

using scene::TexelImage;
using scene::Texture;

// Encodings besides powers, in the values of Mitsuba's `gamma`.
constexpr double by_file = 0, srgb = -1, linear = 1;

double decode(double encoded, double gamma) {
  if (gamma == srgb) return decode_srgb(encoded);
  return gamma == linear ? encoded : std::pow(encoded, gamma);
}

void find_range(TexelImage& image) {
  const bool bytes = !image.bytes.empty();
  const std::size_t stride = bytes ? 4 : 3, size = bytes ? image.bytes.size() : image.floats.size();
  for (int channel = 0; channel < 3; ++channel) {
    double least = INFINITY, most = -INFINITY;
    for (std::size_t i = static_cast<std::size_t>(channel); i < size; i += stride) {
      const double value = static_cast<double>(bytes ? image.decoded[image.bytes[i]] : image.floats[i]);
      least = std::min(least, value);
      most = std::max(most, value);
    }
    image.smallest[channel] = least;
    image.largest[channel] = most;
  }
}

void decode_floats(TexelImage& image, double gamma, const std::filesystem::path& file,
                   const Location& named_at) {
  const auto negative = std::ranges::find_if(image.floats, [](float value) { return value < 0; });
  if (negative != image.floats.end()) {
    const auto pixel = (negative - image.floats.begin()) / 3;
    fail_in_image(file, named_at,
                  fmt::format("pixel ({}, {}) is negative", pixel % image.width, pixel / image.width),
                  "reflectances of 0 or more");
  }
  if (gamma == linear) return;
  for (float& value : image.floats) value = static_cast<float>(decode(static_cast<double>(value), gamma));
}

/// Sets all channels of every pixel to its luminance (Rec. 709).
void keep_luminance(TexelImage& image) {
  const auto luminance = [](float r, float g, float b) {
    return 0.212671f * r + 0.715160f * g + 0.072169f * b;
  };
  if (image.floats.empty()) image.floats.resize(image.bytes.size() / 4 * 3);
  for (std::size_t pixel = 0; pixel < image.floats.size() / 3; ++pixel) {
    float* const to = &image.floats[3 * pixel];
    const std::uint8_t* const bytes = image.bytes.empty() ? nullptr : &image.bytes[4 * pixel];
    const auto& decoded = image.decoded;
    const float y = bytes ? luminance(decoded[bytes[0]], decoded[bytes[1]], decoded[bytes[2]])
                          : luminance(to[0], to[1], to[2]);
    to[0] = to[1] = to[2] = y;
  }
  image.bytes.clear();
}

Texture::Wrap wrap(Properties& properties, const std::string& name, const std::string& otherwise) {
  const std::string mode = properties.string(name, otherwise);
  if (mode == "repeat") return Texture::Wrap::repeat;
  if (mode == "mirror") return Texture::Wrap::mirror;
  if (mode == "clamp") return Texture::Wrap::clamp;
  properties.fail_at(name, "'" + mode + "' is not supported", "repeat, mirror or clamp");
}

bool is_nearest(Properties& properties) {
  const std::string filter = properties.string("filter_type", "bilinear");
  if (filter == "ewa" || filter == "trilinear")
    properties.document().warnings->add(properties.where("filter_type"),
                                        "'" + filter +
                                            "' is not supported; bilinear is used, and the samples of a "
                                            "pixel average what it covers");
  else if (filter != "bilinear" && filter != "nearest")
    properties.fail_at("filter_type", "'" + filter + "' is not supported", "bilinear or nearest");
  return filter == "nearest";
}

/// Mitsuba 0.x has scales and offsets, 3.x a transform.
std::array<double, 6> to_uv(Properties& properties) {
  const glm::dmat4 m = properties.transform("to_uv");
  const double us = properties.real("uscale", 1), vs = properties.real("vscale", 1);
  const double uo = properties.real("uoffset", 0), vo = properties.real("voffset", 0);
  return {us * m[0][0], us * m[1][0], us * m[3][0] + uo, vs * m[0][1], vs * m[1][1], vs * m[3][1] + vo};
}

/// Of a bitmap whose values are those of one channel: r, g, b or a; empty for all.
std::string channel_of(Properties& properties) {
  const std::string channel = properties.string("channel", "");
  if (channel.empty() || channel == "r" || channel == "g" || channel == "b" || channel == "a") return channel;
  properties.fail_at("channel", "'" + channel + "' is not supported", "r, g, b or a");
}

/// Sets all channels of every pixel to this one of the file, unless it is alpha, as which it has been read.
void keep_channel(ImageFile& image, const std::string& channel) {
  if (channel.empty() || channel == "a" || channel == "y") return;
  const std::size_t kept = channel == "r" ? 0 : channel == "g" ? 1 : 2;
  for (std::size_t i = 0; i < image.bytes.size(); i += 4)
    image.bytes[i] = image.bytes[i + 1] = image.bytes[i + 2] = image.bytes[i + kept];
  for (std::size_t i = 0; i < image.floats.size(); i += 3)
    image.floats[i] = image.floats[i + 1] = image.floats[i + 2] = image.floats[i + kept];
}

double gamma_of(Properties& properties) {
  const double gamma = properties.real("gamma", by_file);
  if (gamma < 0 && gamma != srgb)
    properties.fail_at("gamma", fmt::format("{:g} is no encoding", gamma),
                       "-1 (sRGB), 1 (linear) or another exponent above 0");
  return properties.boolean("raw", false) ? linear : gamma;
}

void read_colors(Properties& properties, Texture& texture) {
  for (const int i : {0, 1}) {
    const std::string name = fmt::format("color{}", i);
    scene::Rgb& color = texture.colors[static_cast<std::size_t>(i)];
    color = properties.color(name, color);
    if (std::min({color.r, color.g, color.b}) < 0)
      properties.fail_at(name, "a negative colour", "0 or more in every channel");
  }
}

} // namespace

scene::TexturePointer TextureReader::read(const Element& element, const Document& document, bool as_number) {
  if (element.type() == "scale") return read_scaled(element, document, as_number);
  Properties properties(element, document);
  Texture texture;
  texture.to_uv = to_uv(properties);
  if (element.type() == "checkerboard") {
    read_colors(properties, texture);
  } else if (element.type() == "bitmap") {
    const std::string name = properties.string("filename", "");
    if (name.empty())
      fail(element.where, element.name() + " without a filename", "<string name=\"filename\" .../>");
    const double gamma = gamma_of(properties);
    texture.nearest = is_nearest(properties);
    const std::string mode = properties.string("wrap_mode", "repeat");
    texture.wrap_u = texture.wrap_v = wrap(properties, "wrap_mode", mode);
    texture.wrap_u = wrap(properties, "wrap_mode_u", mode);
    texture.wrap_v = wrap(properties, "wrap_mode_v", mode);
    std::string channel = channel_of(properties);
    if (channel.empty() && as_number) channel = "y";
    texture.image = image(document.find(name), {gamma, channel}, properties.where("filename"));
    properties.pass_over({"cache", "max_anisotropy", "format", "accel"});
  } else {
    fail(element.where, element.name() + " is not supported",
         "supported are bitmap, checkerboard, and scale around one of them");
  }
  properties.finish();
  return std::make_shared<const Texture>(texture);
}

/// Mitsuba 0.6's product of a texture and a number or a colour.
scene::TexturePointer TextureReader::read_scaled(const Element& element, const Document& document,
                                                 bool as_number) {
  Properties properties(element, document);
  const Element* nested = properties.object("texture");
  if (!nested) fail(element.where, element.name() + " around nothing", "one nested or referenced <texture>");
  const scene::Rgb factor = properties.color("scale", scene::Rgb(1.0), HUGE_VAL);
  if (std::min({factor.r, factor.g, factor.b}) < 0)
    properties.fail_at("scale", "a negative factor", "0 or more in every channel");
  Texture texture = *read(*nested, document, as_number);
  if (!texture.image) {
    for (scene::Rgb& color : texture.colors) color *= factor;
  } else if (factor.r == factor.g && factor.g == factor.b) {
    texture.scale *= factor.r;
  } else {
    properties.fail_at("scale", "a bitmap with a colour",
                       "<float name=\"scale\" .../>, one factor for all channels");
  }
  properties.finish();
  return std::make_shared<const Texture>(texture);
}

const TextureReader::Image& TextureReader::image(const std::filesystem::path& file, Decoding decoding,
                                                 const Location& named_at) {
  Image& known = images_[{file, decoding}];
  if (known) return known;
  const bool alpha = decoding.channel == "a"; // is linear, as in Mitsuba
  ImageFile read = read_image(file, named_at, alpha ? ImageChannels::alpha : ImageChannels::colors);
  keep_channel(read, decoding.channel);
  double gamma = alpha ? linear : decoding.gamma;
  if (gamma == by_file) gamma = read.is_encoded ? srgb : linear;
  TexelImage result;
  result.width = read.width;
  result.height = read.height;
  result.bytes = std::move(read.bytes);
  result.floats = std::move(read.floats);
  for (std::size_t i = 0; i < result.decoded.size(); ++i)
    result.decoded[i] = static_cast<float>(decode(static_cast<double>(i) / 255, gamma));
  decode_floats(result, gamma, file, named_at);
  if (decoding.channel == "y") keep_luminance(result);
  find_range(result);
  return known = std::make_shared<const TexelImage>(std::move(result));
}

} // namespace phlux::scene_file
