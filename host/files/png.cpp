#include "files/png.h"

#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <new>
#include <sstream>
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

namespace {

// A PNG file that is written row by row. Libpng's errors are long jumps, which must not pass objects with
// destructors.
class RowWriter {
public:
  explicit RowWriter(std::ostream& to)
      : to_(to), png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, this, note_error, ignore_warning)),
        info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {
    if (info_ != nullptr) return;
    png_destroy_write_struct(&png_, nullptr);
    throw std::bad_alloc();
  }
  ~RowWriter() { png_destroy_write_struct(&png_, &info_); }
  RowWriter(const RowWriter&) = delete;
  RowWriter& operator=(const RowWriter&) = delete;

  void begin(int width, int height) {
    size_ = fmt::format("{}x{}", width, height);
    call([&] {
      png_set_write_fn(png_, this, write_bytes, nullptr);
      png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
      png_set_IHDR(png_, info_, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8,
                   PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
      png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
      png_write_info(png_, info_);
    });
  }
  void add(const Color* row) {
    static_assert(sizeof(Color) == 3);
    call([&] { png_write_row(png_, &row->red); });
  }
  void end() {
    call([&] { png_write_end(png_, nullptr); });
  }

private:
  template<class Call>
  void call(const Call& of_libpng) {
    if (setjmp(png_jmpbuf(png_)) != 0)
      throw WriteError(fmt::format("a PNG file of {} pixels cannot be written: {}: smaller images are needed",
                                   size_, error_));
    of_libpng();
  }
  static void note_error(png_structp png, png_const_charp message) {
    static_cast<RowWriter*>(png_get_error_ptr(png))->error_ = message;
    png_longjmp(png, 1);
  }
  static void ignore_warning(png_structp, png_const_charp) {}
  static void write_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    static_cast<RowWriter*>(png_get_io_ptr(png))
        ->to_.write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  }

  std::ostream& to_;
  std::string size_, error_;
  png_structp png_;
  png_infop info_;
};

// `row_of(y)`: the first pixel of a row.
template<class RowOf>
void encode(int width, int height, const RowOf& row_of, std::ostream& to) {
  RowWriter writer(to);
  writer.begin(width, height);
  for (int y = 0; y < height; ++y) writer.add(row_of(y));
  writer.end();
}

} // namespace

std::string encode_png(const Canvas& canvas) {
  std::ostringstream stream(std::ios::binary);
  const auto row_of = [&](int y) {
    return &canvas.pixels()[static_cast<std::size_t>(y) * static_cast<std::size_t>(canvas.width())];
  };
  encode(canvas.width(), canvas.height(), row_of, stream);
  return std::move(stream).str();
}

void encode_png(const Rows& rows, std::optional<double> stops, std::ostream& to) {
  const float scale = stops ? static_cast<float>(std::exp2(*stops)) : exposure(rows);
  const auto code = [scale](float value) { return srgb_code(compress_highlights(scale * value)); };
  RadianceRow radiance(rows);
  std::vector<Color> colors(static_cast<std::size_t>(rows.width));
  const auto row_of = [&](int y) {
    radiance.read(y);
    for (std::size_t x = 0; x < colors.size(); ++x)
      colors[x] = {code(radiance.values[0][x]), code(radiance.values[1][x]), code(radiance.values[2][x])};
    return colors.data();
  };
  encode(rows.width, rows.height, row_of, to);
}

std::string encode_png(const Image& image, std::optional<double> stops) {
  std::ostringstream stream(std::ios::binary);
  encode_png(rows_of(image), stops, stream);
  return std::move(stream).str();
}

void write_png(const std::filesystem::path& file, const Rows& rows, std::optional<double> stops) {
  write_file(file, [&](std::ostream& to) { encode_png(rows, stops, to); });
}

} // namespace phlux::files
