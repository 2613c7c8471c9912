#include "images/evidence.h"

#include <atomic>
#include <cctype>
#include <filesystem>
#include <map>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "files/exr.h"

namespace phlux::test {
namespace {

constexpr std::size_t longest_name = 80; // of a file, before its number

// Name of the running test case in characters allowed in file names, with a unique number.
std::string file_name() {
  static std::atomic<int> count = 0;
  std::string name = Catch::getResultCapture().getCurrentTestName().substr(0, longest_name);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
  return fmt::format("{}-{}", name, ++count);
}

void write(const std::filesystem::path& file, int width, int height, const std::vector<Channels>& values) {
  files::Image image{width, height, {}, {}};
  image.info.scene = Catch::getResultCapture().getCurrentTestName();
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float>& channel = image.channels[std::string(1, "RGB"[c])];
    for (const Channels& value : values) channel.push_back(static_cast<float>(value[c]));
  }
  files::write_exr(file, image);
}

std::vector<Channels> sum_of(std::vector<Channels> a, const std::vector<Channels>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) a[i][c] += b[i][c];
  return a;
}

} // namespace

std::string leave_evidence(const Estimate& image, const Estimate& reference, double tolerance) {
  const std::filesystem::path folder = PHLUX_EVIDENCE_FOLDER;
  std::filesystem::create_directories(folder);
  const std::string name = (folder / file_name()).string();
  write(name + ".image.exr", image.width, image.height, image.mean);
  write(name + ".reference.exr", reference.width, reference.height, reference.mean);
  if (image.width != reference.width || image.height != reference.height)
    return fmt::format("see {}.{{image,reference}}.exr", name);
  write(name + ".variance.exr", image.width, image.height, sum_of(image.variance, reference.variance));
  write(name + ".p.exr", image.width, image.height, p_of_pixels(image, reference, tolerance));
  return fmt::format("see {}.{{image,reference,variance,p}}.exr", name);
}

void check(const Agreement& result, const Estimate& image, const Estimate& reference, double tolerance) {
  const std::string evidence = result.agrees ? "" : leave_evidence(image, reference, tolerance);
  INFO(result.message << "\n" << evidence);
  CHECK(result.agrees);
}

void check_agreement(const Estimate& image, const Estimate& reference, double tolerance) {
  check(agreement(image, reference, tolerance), image, reference, tolerance);
}

void check_agreement_of_pixels(const Estimate& image, const Estimate& reference, double tolerance) {
  check(agreement_of_pixels(image, reference, tolerance), image, reference, tolerance);
}

} // namespace phlux::test
