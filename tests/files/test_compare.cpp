#include "files/compare.h"

#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <catch2/catch.hpp>

#include "errors.h"
#include "files/json.h"

using namespace phlux::files;

namespace {

Image constant(int width, int height, float value) {
  const std::vector<float> values(static_cast<std::size_t>(width * height), value);
  return {width, height, {{"R", values}, {"G", values}, {"B", values}}, {}};
}

void add_variance(Image& image, float value) {
  for (const char* name : {"variance.R", "variance.G", "variance.B"})
    image.channels[name] = std::vector<float>(image.channels["R"].size(), value);
}

std::set<std::string> keys(const nlohmann::ordered_json& json) {
  std::set<std::string> names;
  for (const auto& [name, _] : json.items()) names.insert(name);
  return names;
}

} // namespace

TEST_CASE("Known figures of two constant images") {
  const Comparison result = compare(constant(4, 2, 3.0F), constant(4, 2, 2.0F), "a", "b");
  CHECK(result.mean_a == 3.0);
  CHECK(result.mean_b == 2.0);
  CHECK(result.mean_ratio == 1.5);
  CHECK(result.mean_error == 0.5);
  CHECK(result.rmse == 1.0);
  CHECK(result.relmse == Approx(1.0 / 4.0001));
  CHECK(result.relmse_trimmed == Approx(result.relmse));
  CHECK_FALSE(result.max_z.has_value());
  CHECK(result.nonfinite == 0);
}

TEST_CASE("Different parts of an image are not compared") {
  Image a = constant(4, 2, 1.0F), b = a;
  a.info.whole = b.info.whole = {8, 8};
  b.info.origin = {4, 0};
  CHECK_THROWS_WITH(compare(a, b, "a", "b"),
                    Catch::Contains("a and b: are different parts of an image (`crop`)"));
}

TEST_CASE("Channels have means of their own") {
  Image a = constant(2, 1, 1.0F), b = constant(2, 1, 2.0F);
  a.channels["R"] = {1.0F, 2.0F};
  b.channels["B"] = {0.0F, 8.0F};
  const Comparison result = compare(a, b, "a", "b");
  CHECK(result.mean_a_rgb == std::array{1.5, 1.0, 1.0});
  CHECK(result.mean_b_rgb == std::array{2.0, 2.0, 4.0});
  CHECK(result.mean_error == Approx(1.0 - 3.5 / 8.0));
}

TEST_CASE("PSNR is that of what a screen shows, exposed as the reference is") {
  const float brightness = GENERATE(1e-3F, 1.0F, 1e6F);
  const Image b = constant(4, 2, 2.0F * brightness);
  // b is exposed to 0.18 and a to 0.27: -20 log10(0.5563... - 0.4613...) by IEC 61966-2-1
  CHECK(compare(constant(4, 2, 3.0F * brightness), b, "a", "b").psnr == Approx(20.4421).epsilon(1e-4));
  CHECK(std::isinf(compare(b, b, "b", "b").psnr));
  Image spot = b; // 1 of 24 values burns out: from 0.4613... to 1
  spot.channels["G"][3] = 1e9F * brightness;
  CHECK(compare(spot, b, "a", "b").psnr == Approx(19.1761).epsilon(1e-4));
}

TEST_CASE("The trimmed figure leaves the largest 0.1% of pixels out") {
  Image a = constant(1000, 2, 1.0F);
  const Image b = constant(1000, 2, 1.0F);
  a.channels["R"][17] = 1001.0F; // two pixels of 2000, in one channel each
  a.channels["G"][1500] = 501.0F;
  const Comparison two = compare(a, b, "a", "b");
  CHECK(two.relmse == Approx((1e6 + 25e4) / 1.0001 / 6000.0));
  CHECK(two.relmse_trimmed == 0.0);
  a.channels["B"][3] = 2.0F;
  CHECK(compare(a, b, "a", "b").relmse_trimmed == Approx(1.0 / 1.0001 / 3.0 / 1998.0));
}

TEST_CASE("z is measured in standard deviations of the difference") {
  Image a = constant(10, 10, 1.0F), b = constant(10, 10, 1.0F);
  add_variance(a, 0.03F);
  CHECK_FALSE(compare(a, b, "a", "b").max_z.has_value());
  add_variance(b, 0.01F);
  a.channels["G"][7] = 2.0F; // 5 standard deviations of 0.2
  a.channels["B"][8] = 1.5F; // 2.5
  const Comparison result = compare(a, b, "a", "b");
  CHECK(*result.max_z == Approx(5.0));
  CHECK(*result.z_share_over_3 == Approx(1.0 / 300.0));
}

TEST_CASE("Without noise, rounding alone is not significant and a difference is") {
  Image a = constant(1, 1, 1.0F), b = constant(1, 1, std::nextafter(1.0F, 2.0F));
  add_variance(a, 0.0F);
  add_variance(b, 0.0F);
  CHECK(*compare(a, b, "a", "b").max_z < 1.0);
  CHECK(*compare(a, a, "a", "a").max_z == 0.0);
  b.channels["R"][0] = 1.1F;
  CHECK(*compare(a, b, "a", "b").max_z > 1000.0);
  add_variance(b, -1.0F); // of another program
  CHECK(*compare(a, b, "a", "b").max_z > 1000.0);
}

TEST_CASE("Values that are not finite are counted and their pixels left out") {
  Image a = constant(4, 1, 1.0F), b = constant(4, 1, 2.0F);
  a.channels["R"][0] = std::numeric_limits<float>::quiet_NaN();
  b.channels["B"][0] = std::numeric_limits<float>::infinity();
  b.channels["G"][1] = -std::numeric_limits<float>::infinity();
  const Comparison result = compare(a, b, "a", "b");
  CHECK(result.nonfinite == 3);
  CHECK(result.mean_ratio == 0.5);
  CHECK(result.rmse == 1.0);
}

TEST_CASE("Images of different sizes or without R, G, B cannot be compared") {
  const Image a = constant(4, 2, 1.0F);
  Image b = constant(2, 4, 1.0F);
  CHECK_THROWS_AS(compare(a, b, "a.exr", "b.exr"), phlux::FileError);
  CHECK_THROWS_WITH(compare(a, b, "a.exr", "b.exr"),
                    Catch::StartsWith("a.exr: is 4x2 pixels, but b.exr is 2x4"));
  b = a;
  b.channels.erase("G");
  CHECK_THROWS_WITH(compare(a, b, "a.exr", "b.exr"), Catch::StartsWith("b.exr: has no channel G"));
}

TEST_CASE("The JSON has the contract's keys, and null for what is undefined") {
  Image a = constant(1, 1, 1.0F);
  const std::set<std::string> always = {"mean_a",     "mean_b",         "mean_ratio", "rmse",
                                        "relmse",     "relmse_trimmed", "nonfinite",  "psnr",
                                        "mean_error", "mean_a_rgb",     "mean_b_rgb"};
  CHECK(keys(to_json(compare(a, a, "a", "a"))) == always);
  add_variance(a, 1.0F);
  std::set<std::string> with_z = always;
  with_z.insert({"max_z", "z_share_over_3"});
  CHECK(keys(to_json(compare(a, a, "a", "a"))) == with_z);
  for (const char* name : metric_names) CHECK(with_z.contains(name));

  const Image black = constant(1, 1, 0.0F);
  const auto json = nlohmann::json::parse(json_text(to_json(compare(black, black, "a", "b"))));
  CHECK(json["mean_ratio"].is_null());
  CHECK(json["psnr"].is_null());
  CHECK(json["mean_a_rgb"] == nlohmann::json{0.0, 0.0, 0.0});
  CHECK(json["rmse"] == 0.0);
}
