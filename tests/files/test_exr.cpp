#include "files/exr.h"

#include <limits>
#include <random>

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <catch2/catch.hpp>
#include <sys/stat.h>

#include "errors.h"
#include "files/output.h"
#include "temporary_folder.h"

using phlux::FileError;
using phlux::film::Film;
using namespace phlux::files;

namespace {

const RenderInfo render_info{.version = "0.1.0",
                             .scene = "scenes/box.xml",
                             .scene_digest = "0af",
                             .settings = {{"integrator", "path"},
                                          {"strategy", "mixture"},
                                          {"max-depth", std::int64_t{9}},
                                          {"clamp", 4.0}},
                             .choice =
                                 "--integrator path: in trials 2 times as efficient as --integrator bidir",
                             .samples = 64.0,
                             .seed = std::numeric_limits<std::uint64_t>::max(),
                             .ranges = {{std::numeric_limits<std::uint64_t>::max(), 0, 64}, {7, 64, 128}},
                             .device = "a device",
                             .driver = "3.1",
                             .seconds = 1.5,
                             .clamped_share = 0.25};

Film numbered_film() {
  Film film(3, 2);
  for (std::size_t pixel = 0; pixel < 6; ++pixel) {
    const float x = static_cast<float>(pixel);
    film.add(pixel, {{x, 2 * x, 1e9F * x}, {x * x, 4 * x * x, 1e18F * x * x}}, 2);
  }
  return film;
}

} // namespace

TEST_CASE("An image comes back from an EXR file bit for bit") {
  const TemporaryFolder folder;
  const Image image = image_of(numbered_film(), render_info, true);
  write_exr(folder / "a.exr", image);
  const Image back = read_exr(folder / "a.exr");
  CHECK(back.width == 3);
  CHECK(back.height == 2);
  CHECK(back.channels == image.channels);
  CHECK(back.channels.at("R") ==
        std::vector<float>{0.0F, 0.5F, 1.0F, 1.5F, 2.0F, 2.5F}); // the mean, top row first
  CHECK(back.channels.at("B")[5] == 2.5e9F);                     // neither clamped nor exposed
  CHECK(back.channels.at("variance.R")[4] == 4.0F); // samples 0 and 4, or Q = 16: (16/2 - 2^2) / 1
}

TEST_CASE("A crop lies in the data window of the whole image") {
  const TemporaryFolder folder;
  RenderInfo info = render_info;
  info.origin = {5, 7};
  info.whole = {20, 10};
  write_exr(folder / "a.exr", image_of(numbered_film(), info, false));
  const Imf::InputFile file((folder / "a.exr").c_str());
  CHECK(file.header().displayWindow() == Imath::Box2i({0, 0}, {19, 9}));
  CHECK(file.header().dataWindow() == Imath::Box2i({5, 7}, {7, 8}));
  const Image back = read_exr(folder / "a.exr");
  CHECK(back.channels.at("R") == std::vector<float>{0.0F, 0.5F, 1.0F, 1.5F, 2.0F, 2.5F});
  CHECK(back.info.origin == info.origin);
  CHECK(back.info.whole == info.whole);
}

TEST_CASE("An EXR file has the channels and attributes of the contract") {
  const TemporaryFolder folder;
  const bool moments = GENERATE(false, true);
  write_exr(folder / "a.exr", image_of(numbered_film(), render_info, moments));
  const Imf::InputFile file((folder / "a.exr").c_str());
  const Imf::Header& header = file.header();

  std::map<std::string, Imf::PixelType> channels;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    channels[channel.name()] = channel.channel().type;
  CHECK(channels.size() == (moments ? 7 : 3));
  CHECK(channels.contains("variance.G") == moments);
  for (const auto& [name, type] : channels) CHECK(type == Imf::FLOAT);

  const auto text = [&](const char* name) {
    return header.typedAttribute<Imf::StringAttribute>(name).value();
  };
  const auto number = [&](const char* name) {
    return header.typedAttribute<Imf::DoubleAttribute>(name).value();
  };
  CHECK(text("bias") == "clamped");
  CHECK(number("clamp") == 4.0);
  CHECK(number("clampedShare") == 0.25);
  CHECK(text("version") == "0.1.0");
  CHECK(text("scene") == "scenes/box.xml");
  CHECK(text("integrator") == "path");
  CHECK(text("strategy") == "mixture");
  CHECK(number("samples") == 64.0);
  CHECK(text("seed") == "18446744073709551615, 7");
  CHECK(text("sampleRanges") == "18446744073709551615:0-64, 7:64-128");
  CHECK(text("sceneDigest") == "0af");
  CHECK(header.typedAttribute<Imf::IntAttribute>("maxDepth").value() == 9);
  CHECK(text("device") == "a device");
  CHECK(text("driver") == "3.1");
  CHECK(number("seconds") == 1.5);

  const RenderInfo info = read_exr(folder / "a.exr").info;
  CHECK(info.version == render_info.version);
  CHECK(info.scene == render_info.scene);
  CHECK(info.settings == render_info.settings);
  CHECK(info.choice == render_info.choice);
  CHECK(info.samples == render_info.samples);
  CHECK(info.seed == render_info.seed);
  CHECK(info.ranges == render_info.ranges);
  CHECK(info.scene_digest == render_info.scene_digest);
  CHECK(info.seconds == render_info.seconds);
}

TEST_CASE("Other programs' files are read: half channels, an offset data window, no attributes") {
  const TemporaryFolder folder;
  std::vector<half> values = {1.0F, 2.0F, 3.0F, 4.0F};
  const Imath::Box2i window({10, 20}, {11, 21});
  Imf::Header header(window, window);
  header.channels().insert("R", Imf::Channel(Imf::HALF));
  Imf::FrameBuffer frame;
  frame.insert("R", Imf::Slice::Make(Imf::HALF, values.data(), window));
  {
    Imf::OutputFile file((folder / "a.exr").c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(2);
  }
  const Image image = read_exr(folder / "a.exr");
  CHECK(image.channels.at("R") == std::vector<float>{1.0F, 2.0F, 3.0F, 4.0F});
  CHECK(image.info.version.empty());
}

TEST_CASE("What is no EXR image is a FileError of one line that names the file") {
  const TemporaryFolder folder;
  const std::string file = (folder / "a.exr").string();
  SECTION("missing") {}
  SECTION("empty") {
    write_file(file, "");
  }
  SECTION("text") {
    write_file(file, "not an image at all");
  }
  SECTION("cut off") {
    const std::string bytes = encode_exr(image_of(numbered_film(), render_info, true));
    write_file(file, bytes.substr(0, bytes.size() - 20));
  }
  SECTION("damaged header") {
    std::string bytes = encode_exr(image_of(numbered_film(), render_info, true));
    const std::size_t window = bytes.find("dataWindow");
    bytes.replace(window + 31, 8, "\x7f\x7f\x7f\x7f\x7f\x7f\x7f\x7f", 8);
    write_file(file, bytes);
  }
  SECTION("a header that claims more pixels than the file can hold") {
    std::string bytes = encode_exr(image_of(numbered_film(), render_info, true));
    for (const char* name : {"dataWindow", "displayWindow"}) {
      const std::size_t corner =
          bytes.find(name) + std::string(name).size() + 1 + 6 + 4 + 8; // after "box2i", its size and min
      bytes.replace(corner, 8, "\xff\x3f\0\0\xff\x3f\0\0", 8);         // 16383, 16383
    }
    bytes.resize(bytes.size() + (1 << 14)); // with room for its table of chunks
    write_file(file, bytes);
    CHECK_THROWS_WITH(read_exr(file), Catch::Contains("it claims 16384x16384 pixels"));
  }
  SECTION("an attribute that claims more bytes than the file has") {
    std::string bytes = encode_exr(image_of(numbered_film(), render_info, true));
    const std::string attribute("driver\0string", 14);
    bytes.replace(bytes.find(attribute) + attribute.size(), 4, "\x44\x33\x73\x69", 4);
    write_file(file, bytes);
    CHECK_THROWS_WITH(read_exr(file), Catch::Contains("attribute driver claims 1769157444 bytes"));
  }
  SECTION("channels that end before their attribute") {
    std::string bytes = encode_exr(image_of(numbered_film(), render_info, true));
    const std::size_t channels = bytes.find("channels") + std::string("channels chlist ").size() + 4;
    bytes[channels] = '\0';
    write_file(file, bytes);
    CHECK_THROWS_WITH(read_exr(file), Catch::Contains("attribute channels claims"));
  }
  SECTION("a pipe") {
    REQUIRE(::mkfifo(file.c_str(), 0600) == 0);
  }
  SECTION("a folder") {
    std::filesystem::create_directory(file);
  }
  CHECK_THROWS_AS(read_exr(file), FileError);
  CHECK_THROWS_WITH(read_exr(file), Catch::StartsWith(file + ": ") && !Catch::Contains("\n"));
}

TEST_CASE("Only what is used of an EXR file is read; attributes that are not finite or in range are not") {
  const TemporaryFolder folder;
  RenderInfo info = render_info;
  info.samples = info.seconds = std::numeric_limits<double>::quiet_NaN();
  info.ranges = {{7, 5, 3}};
  Image image = image_of(numbered_film(), info, false);
  image.channels["depth"] = image.channels.at("R");
  image.channels.at("G")[2] = std::numeric_limits<float>::infinity();
  CHECK(write_exr(folder / "a.exr", image) == NonFinite{{"G", 1}});
  const Image back = read_exr(folder / "a.exr");
  CHECK(back.channels.size() == 3);
  CHECK(back.info.samples == 0.0);
  CHECK(back.info.seconds == 0.0);
  CHECK(back.info.ranges.empty());
}

TEST_CASE("A film is written row by row as its image is") {
  Film film(5, 37); // not a whole number of ZIP's blocks of lines
  for (std::size_t pixel = 0; pixel < 5 * 37; ++pixel)
    film.add(pixel, {{static_cast<float>(pixel), 2, 3}, {static_cast<float>(pixel * pixel), 4, 9}}, 2);
  const TemporaryFolder folder;
  CHECK(write_exr(folder / "a.exr", rows_of(film, true), render_info).empty());
  CHECK(TemporaryFolder::read(folder / "a.exr") == encode_exr(image_of(film, render_info, true)));
  CHECK(read_exr(folder / "a.exr").channels == image_of(film, render_info, true).channels);
}

TEST_CASE("An image with a bit flipped, or cut off, is refused, called changed, or read right") {
  const TemporaryFolder folder;
  RenderInfo info = render_info;
  info.version = PHLUX_VERSION;
  const std::string bytes = encode_exr(image_of(numbered_film(), info, true));
  write_file(folder / "right.exr", bytes);
  const Image right = read_exr(folder / "right.exr");
  std::mt19937 random(1);
  int refused = 0;
  constexpr int files = 1000;
  for (int i = 0; i < files; ++i) {
    const std::size_t place = random() % bytes.size();
    const unsigned bit = random() % 16; // eight of them cut the file off
    std::string damaged = bytes;
    if (bit < 8)
      damaged[place] = static_cast<char>(damaged[place] ^ (1 << bit));
    else
      damaged.resize(place);
    folder.write("damaged.exr", damaged);
    CAPTURE(i, place, bit);
    try {
      const Image image = read_exr(folder / "damaged.exr");
      const bool is_right = image.channels == right.channels && image.width == right.width &&
                            image.info.samples == info.samples && image.info.ranges == info.ranges &&
                            image.info.settings == info.settings;
      CHECK((is_right || image.info.is_changed));
    } catch (const FileError&) {
      ++refused;
    }
  }
  CHECK(refused > files / 2);
}
