// Images of Mitsuba 3 (tests/references): an error that path, light and bidirectional path tracing share
// shows here alone.
#include <catch2/catch.hpp>

#include "files/exr.h"
#include "images/integrators.h"
#include "scene_file/load.h"

using namespace phlux;
using namespace phlux::test;

namespace {

const std::filesystem::path folder = PHLUX_SOURCE_DIR "/tests/references";

/// Pixels darker than this fraction of the image's mean get it as their standard error: perhaps no sample
/// hits an edge of something bright that shows in them.
constexpr double visible = 0.01;
/// Lower bound on the standard error of all other pixels, as a fraction of the image's mean: if only a few
/// samples hit an edge that shows in a pixel, the estimate of its variance is unreliable.
constexpr double least_error = 0.001;

/// The image, and its mean with the variance of independent pixels.
Repeated reference(const std::string& name, int renders) {
  const files::Image file = files::read_exr(folder / (name + ".exr"));
  REQUIRE(file.has(files::variance_names));
  Repeated result;
  result.renders = renders;
  result.image = closed_form(file.width, file.height, std::vector<Channels>(file.channels.at("R").size()));
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < result.image.mean.size(); ++i) {
      result.image.mean[i][c] = static_cast<double>(file.channels.at(files::radiance_names[c])[i]);
      result.image.variance[i][c] = static_cast<double>(file.channels.at(files::variance_names[c])[i]);
    }
  result.mean = tiles(result.image, file.width);
  for (std::size_t c = 0; c < 3; ++c) {
    const double least = visible * result.mean.mean[0][c];
    for (std::size_t i = 0; i < result.image.mean.size(); ++i) {
      const double error = result.image.mean[i][c] < least ? least : least_error * result.mean.mean[0][c];
      result.image.variance[i][c] = std::max(result.image.variance[i][c], error * error);
    }
  }
  return result;
}

/// z-tests of all pixels and of the image's mean, by methods that find all of the light; a false alarm has
/// the probability 2 false_alarm_rate for each method.
void check_against_mitsuba(const std::string& name, const std::vector<Method>& methods,
                           double tolerance = rounding, const std::string& file = "",
                           const std::map<std::string, std::string>& definitions = {}) {
  constexpr int renders = 16, samples = 128; // per render
  const scene::Scene scene = scene_file::load(folder / ((file.empty() ? name : file) + ".xml"), definitions);
  const Repeated expected = reference(name, renders);
  for (const Method& method : methods) {
    INFO(name << " by " << name_of(method));
    check_methods(repeated(scene, method, settings_for(method, samples, scene.defaults.max_depth), renders),
                  expected, 1, tolerance);
  }
}

} // namespace

TEST_CASE("references of Mitsuba: Phong's mixture, a spot light") {
  check_against_mitsuba("phong", {path, light, bidir});
}

TEST_CASE("references of Mitsuba: rough conductors, named metals, a mirror") {
  check_against_mitsuba("metals", {path, bidir});
}

TEST_CASE("references of Mitsuba: rough dielectrics") {
  check_against_mitsuba("rough-glass", {path, bidir});
}

TEST_CASE("references of Mitsuba: plastic and rough plastic") {
  // Mitsuba's reflectance of the rough surface from inside is a sum over 64 cosines, a 64th too small.
  check_against_mitsuba("plastics", {path, bidir}, 0.02);
}

TEST_CASE("references of Mitsuba: bitmaps by wrap mode and filter, a checkerboard") {
  check_against_mitsuba("textures", {path, light});
}

TEST_CASE("references of Mitsuba: an environment map, a thin lens, instances") {
  check_against_mitsuba("sky", {path, bidir});
}

TEST_CASE("references of Mitsuba: interpolated normals, strict and not") {
  check_against_mitsuba("smooth", {path, light, bidir});
  check_against_mitsuba("smooth-strict", {path, light}, rounding, "smooth", {{"strict", "true"}});
}

TEST_CASE("references of Mitsuba: glass") {
  check_against_mitsuba("caustic", {path, bidir});
}
