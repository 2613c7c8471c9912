// A failed comparison writes images.
#include <catch2/catch.hpp>

#include "files/exr.h"
#include "images/evidence.h"

using namespace phlux;
using namespace phlux::test;

namespace {

// 3x2 pixels of mean 1 and standard error 0.1; channel G of the pixel (1, 1) is off by three of those.
Estimate estimate(double off = 0) {
  Estimate image{3, 2, std::vector<Channels>(6, {1, 1, 1}), std::vector<Channels>(6, {0.01, 0.01, 0.01})};
  image.mean[4][1] += off;
  return image;
}
const Estimate exact = closed_form(3, 2, std::vector<Channels>(6, {1, 1, 1}));

// "see FOLDER/NAME.{...}.exr": the file of one kind.
std::filesystem::path file_of(const std::string& line, const std::string& kind) {
  REQUIRE(line.starts_with("see "));
  return line.substr(4, line.find(".{") - 4) + "." + kind + ".exr";
}

} // namespace

TEST_CASE("evidence: image, reference, variance and p of every pixel, named after the test case") {
  const std::string line = leave_evidence(estimate(0.3), exact, 0);
  CHECK_THAT(line, Catch::Contains("evidence--image--reference"));
  const auto green = [&](const char* kind) { return files::read_exr(file_of(line, kind)).channels.at("G"); };
  CHECK(green("image") == std::vector<float>{1, 1, 1, 1, 1.3F, 1});
  CHECK(green("reference") == std::vector<float>{1, 1, 1, 1, 1, 1});
  CHECK(green("variance") == std::vector<float>(6, 0.01F));
  const std::vector<float> p = green("p");
  CHECK(p[4] == Approx(0.0026998)); // two-sided, of 3 standard errors
  CHECK(p[3] == 1);
  CHECK(leave_evidence(estimate(), exact) != line); // a new name
}

TEST_CASE("evidence: images of different sizes are left without p") {
  const std::string line = leave_evidence(estimate(), closed_form(1, 1, {{1, 1, 1}}));
  CHECK(files::read_exr(file_of(line, "reference")).width == 1);
  CHECK_FALSE(std::filesystem::exists(file_of(line, "p")));
}

// Catch2 counts failures of these as successes.
TEST_CASE("evidence: a comparison of images that differ fails", "[!shouldfail]") {
  check_agreement(estimate(1), exact);
}
TEST_CASE("evidence: a comparison of pixels that differ fails", "[!shouldfail]") {
  check_agreement_of_pixels(estimate(1), exact);
}
TEST_CASE("evidence: images that agree leave none") {
  const auto files = [] {
    return std::distance(std::filesystem::directory_iterator(PHLUX_EVIDENCE_FOLDER), {});
  };
  std::filesystem::create_directories(PHLUX_EVIDENCE_FOLDER);
  const auto before = files();
  check_agreement(estimate(), exact);
  check_agreement_of_pixels(estimate(), exact);
  CHECK(files() == before);
}
