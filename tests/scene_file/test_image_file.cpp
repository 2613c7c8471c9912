#include <limits>

#include <catch2/catch.hpp>

#include "errors.h"
#include "scene_file/image_file.h"
#include "scene_file/images.h"
#include "scene_file/scenes.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::test;
using Catch::Contains;
using scene_file::ImageFile;

namespace {

const scene_file::Location here{std::make_shared<const std::string>("scene.xml"), 3};

ImageFile image_of(const std::string& bytes) {
  const TemporaryFolder folder;
  folder.write("image", bytes);
  return scene_file::read_image(folder / "image", here);
}

std::string error_of_image(const std::string& bytes) {
  const TemporaryFolder folder;
  folder.write("image", bytes);
  try {
    static_cast<void>(scene_file::read_image(folder / "image", here));
  } catch (const SceneError& error) {
    return without_folder(error.what(), folder);
  }
  return "";
}

using Bytes = std::vector<std::uint8_t>;
using Floats = std::vector<float>;

} // namespace

TEST_CASE("Images of 8 bits keep their bytes, R G B 255, from the top") {
  const ImageFile image = image_of(png());
  CHECK(image.width == 2);
  CHECK(image.height == 2);
  CHECK(image.is_encoded);
  CHECK(image.bytes == Bytes{255, 0, 0, 255, 0, 128, 0, 255, 0, 0, 64, 255, 10, 20, 30, 255});
  CHECK(image_of(bmp()).bytes == Bytes{1, 2, 3, 255, 4, 5, 6, 255, 7, 8, 9, 255, 10, 11, 12, 255});
  CHECK(image_of(tga()).bytes == Bytes{1, 2, 3, 255, 4, 5, 6, 255});
  const ImageFile grey = image_of(jpeg());
  CHECK(grey.width == 8);
  CHECK(Bytes(grey.bytes.end() - 4, grey.bytes.end()) == Bytes{200, 200, 200, 255});
}

TEST_CASE("Images of more bits become floats") {
  const ImageFile deep = image_of(png_of_16_bits());
  CHECK(deep.is_encoded);
  CHECK(deep.floats == Floats{1, 1, 1, 1000.0F / 65535, 1000.0F / 65535, 1000.0F / 65535});
  const ImageFile radiance = image_of(hdr());
  CHECK_FALSE(radiance.is_encoded);
  CHECK(radiance.floats == Floats{0.5F, 0.25F, 8});
  const ImageFile floats = image_of(exr("BGR", {0.25F, 3, 0, 1e-9F, 5, 6}, 3));
  CHECK_FALSE(floats.is_encoded);
  CHECK(floats.width == 3);
  CHECK(Floats(floats.floats.begin(), floats.floats.begin() + 6) == Floats{0.25F, 0.25F, 0.25F, 3, 3, 3});
  CHECK(image_of(exr("Y", {0.5F, 2}, 1)).floats == Floats{0.5F, 0.5F, 0.5F, 2, 2, 2});
}

TEST_CASE("Alpha is read in place of colours, and must be there") {
  const TemporaryFolder folder;
  const auto alpha_of = [&](const std::string& bytes) {
    folder.write("image", bytes);
    return scene_file::read_image(folder / "image", here, scene_file::ImageChannels::alpha);
  };
  const ImageFile image = alpha_of(png_with_alpha());
  CHECK(image.bytes == Bytes{64, 64, 64, 255, 255, 255, 255, 255});
  CHECK_FALSE(image.is_encoded);
  CHECK(image_of(png_with_alpha()).bytes == Bytes{255, 128, 0, 255, 10, 20, 30, 255});
  CHECK(alpha_of(exr("ARGB", {0.5F}, 1)).floats == Floats{0.5F, 0.5F, 0.5F});
  for (const std::string& without : {png(), png_of_16_bits(), hdr(), exr("RGB", {0.5F}, 1)})
    CHECK_THROWS_WITH(alpha_of(without), Contains("the image has no alpha"));
}

TEST_CASE("Images that are cut short, damaged or of no known format are errors") {
  for (const std::string& whole : {png(), jpeg(), bmp(), tga(), hdr(), png_of_16_bits()})
    for (const std::size_t lost : {1, 4})
      if (whole != bmp() || lost > 2) { // the padding of the last row is not needed
        const std::size_t end_of_png = whole.starts_with("\x89PNG") ? 12 : 0; // its end mark is not needed
        CAPTURE(whole.substr(0, 4), lost);
        CHECK_THAT(error_of_image(whole.substr(0, whole.size() - lost - end_of_png)),
                   Catch::StartsWith("scene.xml:3: image file 'image': ") && Contains("the whole file"));
      }
  std::string long_chunk = png(); // claims 1 GB
  long_chunk[33] = '\x40';
  CHECK_THAT(error_of_image(long_chunk), Contains("image file 'image': the image is cut short"));
  const std::string floats = exr("RGB", Floats(64 * 64, 0.5F), 64);
  CHECK_THAT(error_of_image(floats.substr(0, floats.size() / 2)), Contains("cut short"));
  CHECK_THAT(error_of_image(floats.substr(0, 8)), Contains("the whole file"));
  CHECK_THAT(error_of_image(""),
             Contains("image file 'image': ") && Contains("a PNG, JPEG, BMP, TGA, HDR or OpenEXR image"));
  CHECK_THAT(error_of_image("GIF89a"), Contains("a PNG, JPEG, BMP, TGA, HDR or OpenEXR image"));
  CHECK_THAT(error_of_image(exr("A", {1}, 1)),
             Contains("an image of channels A: channels R, G and B, or Y alone"));
  CHECK_THAT(error_of_image(exr("Y", {0, std::numeric_limits<float>::quiet_NaN()}, 1)),
             Contains("image file 'image': pixel (0, 1) is not finite"));
  try {
    static_cast<void>(scene_file::read_image("/nowhere/none.png", here));
    FAIL();
  } catch (const SceneError& error) {
    CHECK_THAT(error.what(), Catch::StartsWith("scene.xml:3: image file '/nowhere/none.png' cannot be read"));
  }
}

TEST_CASE("The size that an image claims is checked before memory is allocated") {
  std::string large = png();
  large.replace(16, 8, from_hex("0000ffff0000ffff")); // width and height, too large for stb_image
  CHECK_THAT(error_of_image(large), Contains("image of at most 16384x16384 pixels"));
  large.replace(16, 10, from_hex("00004001000040010800")); // grey
  CHECK_THAT(error_of_image(large), Contains("16385x16385 pixels is too large: at most 268435456 pixels"));
  large = png();
  large.replace(16, 8, from_hex("0000400000004000"));
  CHECK_THAT(error_of_image(large), Contains("damaged: it claims 16384x16384 pixels in 77 bytes"));
  std::string attribute = exr("Y", {0}, 1); // "compression" is the first with a type of this name
  attribute.replace(attribute.find("compression", 8) + 24, 4, from_hex("ffffff7f"));
  CHECK_THAT(error_of_image(attribute), Contains("attribute compression claims 2147483647 bytes"));
  large.replace(16, 8, from_hex("0000000000000001"));
  CHECK_THAT(error_of_image(large), Contains("image file 'image': ")); // stb_image's own check
}
