#include "files/png.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <png.h>

#include "files/output.h"
#include "files/tone_map.h"

namespace phlux::files {
namespace {

std::vector<std::uint8_t> screen_pixels(const Image& image) {
  const float factor = exposure(image);
  const std::vector<float>* channels[3] = {&image.channels.at("R"), &image.channels.at("G"),
                                           &image.channels.at("B")};
  std::vector<std::uint8_t> codes(3 * channels[0]->size());
  for (std::size_t channel = 0; channel < 3; ++channel)
    for (std::size_t pixel = 0; pixel < channels[channel]->size(); ++pixel)
      codes[3 * pixel + channel] = srgb_code(compress_highlights(factor * (*channels[channel])[pixel]));
  return codes;
}

} // namespace

std::string encode_png(const Image& image) {
  const std::vector<std::uint8_t> pixels = screen_pixels(image);
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  description.width = static_cast<png_uint_32>(image.width);
  description.height = static_cast<png_uint_32>(image.height);
  description.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(description);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&description, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0)
    throw std::runtime_error(description.message);
  bytes.resize(size);
  return bytes;
}

void write_png(const std::filesystem::path& file, const Image& image) {
  write_file(file, encode_png(image));
}

} // namespace phlux::files
