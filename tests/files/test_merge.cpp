#include "files/merge.h"

#include <limits>

#include <catch2/catch.hpp>

#include "errors.h"
#include "files/exr.h"
#include "temporary_folder.h"

using namespace phlux::files;
using Catch::Contains;

namespace {

// 2x1 pixels with the same value.
Image flat(float radiance, float variance, double samples, SampleRange range) {
  Image image{.width = 2, .height = 1, .channels = {}, .info = {}};
  for (const char* name : {"R", "G", "B"}) {
    image.channels[name] = {radiance, radiance};
    image.channels[std::string("variance.") + name] = {variance, variance};
  }
  image.channels["reliability"] = {1, 1};
  image.info = {.version = "0.0.9",
                .scene = "box.xml",
                .scene_digest = "12",
                .settings = {{"integrator", "path"}, {"strategy", "exact"}, {"max-depth", std::int64_t{8}}},
                .choice = {},
                .samples = samples,
                .seed = range.seed,
                .ranges = {range},
                .device = "a",
                .driver = "1",
                .seconds = 2.0};
  return image;
}

const Image first = flat(1, 0.5, 10, {7, 0, 10}), second = flat(4, 0.25, 30, {8, 0, 30});

std::string refusal(Image other, const std::function<void(Image&)>& change) {
  change(other);
  Merger merger;
  merger.add("a.exr", first);
  try {
    merger.add("b.exr", other);
  } catch (const phlux::FileError& error) {
    return error.what();
  }
  return "nothing";
}

std::string refusal(const std::function<void(Image&)>& change) {
  return refusal(second, change);
}

} // namespace

TEST_CASE("Images are weighted by their samples, and their variances by the squares of those weights") {
  Merger merger;
  merger.add("a.exr", first);
  merger.add("b.exr", second);
  CHECK(merger.notes().empty());
  const TemporaryFolder folder;
  write_exr(folder / "m.exr", merger.result());
  const Image merged = read_exr(folder / "m.exr");
  CHECK(merged.channels.size() == 6);
  CHECK(merged.channels.at("G") == std::vector<float>(2, (10 * 1 + 30 * 4) / 40.0F));
  CHECK(merged.channels.at("variance.B") == std::vector<float>(2, (100 * 0.5F + 900 * 0.25F) / 1600));
  CHECK(merged.info.version == PHLUX_VERSION);
  CHECK(merged.info.samples == 40.0);
  CHECK(merged.info.seconds == 4.0);
  CHECK(merged.info.seed == 7);
  CHECK(merged.info.ranges == std::vector<SampleRange>{{7, 0, 10}, {8, 0, 30}});
  CHECK(merged.info.scene_digest == "12");
  CHECK(merged.info.text("max-depth") == "8");
  CHECK(merged.info.device == "a");

  Merger more; // a merged image can be merged again
  more.add("m.exr", merged);
  more.add("c.exr", flat(2, 1, 40, {8, 30, 70}));
  CHECK(more.result().channels.at("R")[0] == Approx((40 * 3.25 + 40 * 2) / 80));
  CHECK(more.result().info.ranges.size() == 3);
}

TEST_CASE("Methods without bias may be merged, and what is lost is noted") {
  Merger merger;
  Image other = second;
  other.info.settings["integrator"] = "bidir";
  other.channels.erase("variance.G");
  other.channels["albedo.R"] = {1, 1};
  merger.add("a.exr", first);
  merger.add("b.exr", other);
  REQUIRE(merger.notes().size() == 3);
  CHECK_THAT(merger.notes()[0], Contains("b.exr is by bidir exact, and a.exr by path exact"));
  CHECK_THAT(merger.notes()[1], Contains("the merged image has no channels albedo.R"));
  CHECK_THAT(merger.notes()[2], Contains("b.exr has no variance channels"));
  CHECK(merger.result().channels.size() == 3);
  CHECK(merger.result().info.text("integrator") == "path, bidir");
  CHECK(merger.result().info.text("strategy") == "exact");
}

TEST_CASE("What cannot be merged is refused, saying why") {
  CHECK(refusal([](Image&) {}) == "nothing");
  CHECK_THAT(refusal([](Image& i) { i.width = 1, i.height = 2; }),
             Contains("b.exr: is 1x2 pixels, but a.exr is 2x1"));
  CHECK_THAT(refusal([](Image& i) { i.info.scene_digest = "13"; }), Contains("b.exr: is of another scene"));
  CHECK_THAT(refusal([](Image& i) { i.info.settings["max-depth"] = std::int64_t{-1}; }),
             Contains("b.exr: was rendered with `max-depth` -1, but a.exr with `max-depth` 8"));
  CHECK_THAT(refusal([](Image& i) { i.info.is_changed = true; }),
             Contains("b.exr: is damaged, or another program"));
  CHECK_THAT(refusal([](Image& i) { i.info.samples = 0; }), Contains("does not say which samples it has"));
  CHECK_THAT(refusal([](Image& i) { i.info.ranges.clear(); }), Contains("does not say which samples it has"));
  CHECK_THAT(refusal([](Image& i) { i.channels.erase("G"); }), Contains("lacks a channel of R, G and B"));
  CHECK_THAT(refusal([](Image& i) { i.info.settings["clamp"] = 4.0; }),
             Contains("b.exr: was rendered with `clamp` 4, but a.exr without `clamp`"));
  CHECK_THAT(refusal([](Image& i) { i.info.settings["strategy"] = "lobe-estimate-printed"; }),
             Contains("which is biased"));
  CHECK(refusal([](Image& i) { i.info.settings["strategy"] = "lobe-estimate"; }) == "nothing");
  CHECK_THAT(refusal([](Image& i) { i.info.missed_light = "light of mirrors"; }),
             Contains("b.exr: `integrator` path finds no light of mirrors, but a.exr: `integrator` path "
                      "finds all light"));
}

TEST_CASE("With clamping, which removes other light from other methods, images of one method are merged") {
  const auto with_integrator = [](const std::string& integrator) {
    Image clamped = first, other = second;
    for (Image* image : {&clamped, &other}) image->info.settings["clamp"] = 4.0;
    other.info.settings["integrator"] = integrator;
    Merger merger;
    merger.add("a.exr", clamped);
    merger.add("b.exr", other);
  };
  CHECK_NOTHROW(with_integrator("path"));
  CHECK_THROWS_WITH(with_integrator("bidir"),
                    Contains("b.exr: was rendered with `integrator` bidir, but a.exr with "
                             "`integrator` path: only images of the same light, and with "
                             "`clamp` by the same method, can be merged"));
}

TEST_CASE("Samples that two images share are refused") {
  const auto with = [](SampleRange range) {
    return refusal([&](Image& i) { i.info.ranges = {{9, 0, 5}, range}; });
  };
  CHECK_THAT(with({7, 0, 10}),
             Contains("b.exr: has samples 0 to 9 of seed 7, and a.exr has samples 0 to 9: render"));
  CHECK_THAT(with({7, 9, 20}), Contains("`first-sample` 10"));
  CHECK(with({7, 10, 20}) == "nothing");
  CHECK(with({6, 0, 10}) == "nothing");
}

TEST_CASE("Numbers of samples that are not finite weigh nothing, and many ranges are checked at once") {
  for (const double samples :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0})
    CHECK_THAT(refusal([&](Image& image) { image.info.samples = samples; }),
               Contains("does not say which samples it has"));
  constexpr int count = 200'000; // with a comparison of each pair 4e10 steps
  Image even = first, odd = second;
  even.info.ranges.clear();
  odd.info.ranges.clear();
  for (int i = 0; i < count; ++i) (i % 2 == 0 ? even : odd).info.ranges.push_back({9, 10 * i, 10 * i + 10});
  Merger merger;
  merger.add("a.exr", even);
  CHECK_NOTHROW(merger.add("b.exr", odd));
  Image again = second;
  again.info.ranges = {{9, 1'000'005, 1'000'006}};
  CHECK_THROWS_WITH(merger.add("c.exr", again),
                    Contains("c.exr: has samples 1000005 to 1000005 of seed 9, and a.exr has "
                             "samples 1000000 to 1000009"));
}
