#include "files/png.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>
#include <png.h>

#include "errors.h"
#include "files/output.h"
#include "files/tone_map.h"

namespace phlux::files {

void draw_image(Canvas& canvas, int left, int top, int zoom, const Image& image, float exposure) {
  const std::vector<float>*red = &image.channels.at("R"), *green = &image.channels.at("G"),
        *blue = &image.channels.at("B");
  const auto code = [exposure](float radiance) {
    return srgb_code(compress_highlights(exposure * radiance));
  };
  std::size_t pixel = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x, ++pixel)
      canvas.fill(left + x * zoom, top + y * zoom, zoom, zoom,
                  {code((*red)[pixel]), code((*green)[pixel]), code((*blue)[pixel])});
}

std::string encode_png(const Canvas& canvas) {
  static_assert(sizeof(Color) == 3);
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  description.width = static_cast<png_uint_32>(canvas.width());
  description.height = static_cast<png_uint_32>(canvas.height());
  description.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(description);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&description, bytes.data(), &size, 0, canvas.pixels().data(), 0, nullptr) ==
      0)
    throw WriteError(
        fmt::format("a PNG file of {}x{} pixels cannot be written: {}: smaller images are needed",
                    canvas.width(), canvas.height(), description.message));
  bytes.resize(size);
  return bytes;
}

std::string encode_png(const Rows& rows, std::optional<double> stops) {
  Canvas canvas(rows.width, rows.height, {});
  const float scale = stops ? static_cast<float>(std::exp2(*stops)) : exposure(rows);
  RadianceRow radiance(rows);
  for (int y = 0; y < rows.height; ++y) {
    radiance.read(y);
    for (int x = 0; x < rows.width; ++x) {
      const auto code = [&](std::size_t channel) {
        return srgb_code(compress_highlights(scale * radiance.values[channel][static_cast<std::size_t>(x)]));
      };
      canvas.fill(x, y, 1, 1, {code(0), code(1), code(2)});
    }
  }
  return encode_png(canvas);
}

void write_png(const std::filesystem::path& file, const Rows& rows, std::optional<double> stops) {
  write_file(file, encode_png(rows, stops));
}

} // namespace phlux::files
