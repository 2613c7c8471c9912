#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/workplace.h"

namespace {

std::string out_of(const std::vector<std::string>& arguments, const Workplace& place) {
  const Outcome outcome = run({arguments, place.path(), {}, {}});
  CAPTURE(arguments, outcome.err);
  REQUIRE(outcome.exit_code == 0);
  return outcome.out;
}

} // namespace

TEST_CASE("info says what is in a scene and how it would be rendered") {
  const Workplace place;
  const auto json = nlohmann::json::parse(out_of({"info", "scene.xml", "--json", "-i", "bidir"}, place));
  CHECK(json["render"]["width"] == 16);
  CHECK(json["render"]["samples_per_pixel"] == 8);
  CHECK(json["shapes"]["spheres"] == 2);
  CHECK(json["shapes"]["parallelograms"] == 1);
  CHECK(json["camera"]["field_of_view"][0].get<double>() == Approx(60.0));
  REQUIRE(json["materials"].size() == 2);
  CHECK(json["materials"][0]["model"] == "diffuse");
  CHECK(json["materials"][0]["parameters"]["reflectance"][2] == 0.5);
  CHECK(json["materials"][0]["shapes"] == 2);
  REQUIRE(json["lights"].size() == 1);
  CHECK(json["lights"][0]["radiance"][0] == 20.0);
  CHECK(json["kernel"]["name"] == "trace_bidir");
  const std::vector<std::string> parts = json["kernel"]["parts"];
  CHECK(std::ranges::count(parts, "light_sphere") == 1);
  CHECK(json["memory"]["image"].get<double>() == 16 * 12 * (64 + 64));
  CHECK(json["memory"]["device"] > 0);

  const std::string text = out_of({"info", "scene.xml", "-D", "radiance=3"}, place);
  for (const char* line :
       {"shapes    1 parallelogram, 2 spheres\n", "light     area: radiance 3 3 3, shapes 1\n",
        "material  diffuse: reflectance 0.5, on 2 shapes\n"})
    CHECK_THAT(text, Catch::Contains(line));
}

TEST_CASE("info shows what is masked, and counts the memory of its texture") {
  const Workplace place;
  const std::string scene = PHLUX_SOURCE_DIR "/scenes/leaves.xml";
  const auto json = nlohmann::json::parse(out_of({"info", scene, "--json"}, place));
  std::vector<std::string> opacities;
  for (const auto& material : json["materials"])
    opacities.push_back(material["parameters"].value("opacity", ""));
  CHECK(std::ranges::count(opacities, "bitmap 96x96") == 1);
  CHECK(std::ranges::count(opacities, "checkerboard") == 1);
  CHECK(json["memory"]["scene"] == 2 * 96 * 96 * 4); // its colours and its opacity
  CHECK_THAT(out_of({"info", scene}, place),
             Catch::Contains("opacity bitmap 96x96, two-sided, on 10 shapes"));
}

TEST_CASE("Without a device info still says what is in a scene") {
  const Workplace place;
  const Outcome outcome = run({{"info", "scene.xml"}, place.path(), {{"OCL_ICD_VENDORS", place.path()}}, {}});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out,
             Catch::Contains("2 spheres") && Catch::Contains("\ndevice    none: no OpenCL platform"));
}
