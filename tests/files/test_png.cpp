#include "files/png.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <png.h>

#include <catch2/catch.hpp>

#include "files/output.h"
#include "files/tone_map.h"
#include "temporary_folder.h"

using namespace phlux::files;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

Image grey(int width, int height, std::vector<float> values) {
  return {width, height, {{"R", values}, {"G", values}, {"B", values}}, {}};
}

struct Decoded {
  unsigned width = 0, height = 0;
  std::vector<unsigned char> codes; // RGB
};

Decoded decode(const std::string& bytes) {
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&description, bytes.data(), bytes.size()) != 0);
  CHECK(description.format == PNG_FORMAT_RGB);
  description.format = PNG_FORMAT_RGB;
  Decoded decoded{description.width, description.height,
                  std::vector<unsigned char>(PNG_IMAGE_SIZE(description))};
  REQUIRE(png_image_finish_read(&description, nullptr, decoded.codes.data(), 0, nullptr) != 0);
  return decoded;
}

} // namespace

TEST_CASE("sRGB codes are those of IEC 61966-2-1") {
  CHECK(srgb_code(0.0F) == 0);
  CHECK(srgb_code(0.0031308F) == 10); // 12.92 x 255 x 0.0031308 = 10.3, where both branches meet
  CHECK(srgb_code(0.18F) == 118);
  CHECK(srgb_code(0.215861F) == 128);
  CHECK(srgb_code(1.0F) == 255);
  CHECK(srgb_code(7.0F) == 255);
  CHECK(srgb_code(-1.0F) == 0);
}

TEST_CASE("A picture may be wider than a million pixels") {
  CHECK_NOTHROW(encode_png(grey(1'000'001, 1, std::vector<float>(1'000'001, 1.0F))));
}

TEST_CASE("Stops replace the exposure of a picture") {
  const Image image = grey(2, 1, {0.02F, 0.5F});
  CHECK(decode(encode_png(image, 0.0)).codes[0] == srgb_code(0.02F));
  CHECK(decode(encode_png(image, 3.0)).codes[0] == srgb_code(0.16F));
  CHECK(decode(encode_png(image, std::log2(exposure(image)))).codes == decode(encode_png(image)).codes);
}

TEST_CASE("Highlights are compressed smoothly and stay in range") {
  CHECK(compress_highlights(0.5F) == 0.5F);
  CHECK(compress_highlights(0.6F) == 0.6F);
  CHECK(compress_highlights(0.601F) == Approx(0.601F).margin(1e-5)); // continuous slope
  CHECK(compress_highlights(1.0F) == Approx(1.0 - 0.4 * std::exp(-1.0)));
  CHECK(compress_highlights(1e30F) == 1.0F);
  CHECK(compress_highlights(infinite) == 1.0F);
  CHECK(compress_highlights(not_a_number) == 0.0F);
  CHECK(compress_highlights(-1.0F) == 0.0F);
  for (float x = 0.0F; x < 5.0F; x += 0.01F) CHECK(compress_highlights(x + 0.01F) > compress_highlights(x));
}

TEST_CASE("The exposure brings an image to middle grey whatever its brightness") {
  const float level = GENERATE(1e-12F, 1e-3F, 1.0F, 2.0F, 1e12F);
  CHECK(exposure(grey(2, 2, std::vector<float>(4, level))) * level == Approx(0.18F));
}

TEST_CASE("Neither a dark background, a light in view nor what is not finite decides the exposure") {
  std::vector<float> values(1000, 0.5F);
  const float plain = exposure(grey(1000, 1, values));
  for (std::size_t i = 0; i < 40; ++i) values[i] = 1e6F;
  for (std::size_t i = 40; i < 80; ++i) values[i] = 1e-20F;
  for (std::size_t i = 80; i < 200; ++i) values[i] = 0.0F;
  values[300] = not_a_number;
  values[301] = infinite;
  CHECK(exposure(grey(1000, 1, values)) == Approx(plain));
  CHECK(exposure(grey(2, 1, {0.0F, 0.0F})) == 1.0F);
  CHECK(exposure(grey(2, 1, {not_a_number, not_a_number})) == 1.0F);
}

TEST_CASE("The bright parts of a picture of high contrast do not burn out") {
  std::vector<float> values(1000, 0.01F);
  std::fill_n(values.begin(), 200, 10.0F);
  CHECK(exposure(grey(1000, 1, values)) * 10.0F == Approx(1.0));
}

TEST_CASE("A preview is an 8-bit sRGB file with the codes that its parts give") {
  Image image = grey(2, 2, {1.0F, 1.0F, 1.0F, 1.0F});
  image.channels["B"] = {0.0F, 0.0F, 0.0F, 0.0F};
  const float factor = exposure(image);
  CHECK(factor == Approx(0.18 / (0.2126 + 0.7152)));
  const Decoded decoded = decode(encode_png(image));
  CHECK(decoded.width == 2);
  CHECK(decoded.height == 2);
  REQUIRE(decoded.codes.size() == 12);
  CHECK(decoded.codes[0] == srgb_code(factor));
  CHECK(decoded.codes[1] == srgb_code(factor));
  CHECK(decoded.codes[2] == 0);
  CHECK(encode_png(image) == encode_png(image));
}

TEST_CASE("Rows run from the top") {
  const Decoded decoded = decode(encode_png(grey(1, 3, {0.0F, 0.1F, 10.0F})));
  CHECK(decoded.codes[0] == 0);
  CHECK(decoded.codes[3] < decoded.codes[6]);
}

TEST_CASE("Black, NaN and infinite images still are pictures") {
  CHECK(decode(encode_png(grey(1, 2, {0.0F, 0.0F}))).codes == std::vector<unsigned char>(6, 0));
  const Decoded odd = decode(encode_png(grey(1, 2, {not_a_number, infinite})));
  CHECK(odd.codes == std::vector<unsigned char>{0, 0, 0, 255, 255, 255});
}
