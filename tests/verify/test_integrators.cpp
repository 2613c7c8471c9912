// The integrators pass in rooms of known radiance; faults of a driver, simulated by wrong kernels, are named.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "kernel_copy.h"
#include "verify/integrators/check_integrators.h"
#include "verify/integrators/furnace.h"
#include "verify/integrators/methods.h"
#include "verify/model.h"

using namespace phlux;
using verify::Rgb;

namespace {

verify::Report run(std::vector<std::string> integrators, bool quick, sources::KernelFiles kernels = {}) {
  verify::Settings settings;
  settings.lanes = 16;
  settings.quick = quick;
  settings.integrators = std::move(integrators);
  settings.kernels = std::move(kernels);
  return verify::run(device::open_devices({}).front(), settings);
}

std::vector<std::string> failures(const verify::Report& report) {
  std::vector<std::string> names;
  for (const verify::Result& result : report.results())
    if (!result.passed) names.push_back(result.strategy + " " + result.check);
  return names;
}

bool is_close(const Rgb& a, const Rgb& b, double error) {
  return std::ranges::all_of(std::array{0, 1, 2}, [&](int c) { return std::abs(a[c] - b[c]) <= error; });
}

} // namespace

TEST_CASE("furnace: radiances of path lengths add up") {
  Rgb sum(0);
  for (int edges = 1; edges <= 100; ++edges) {
    sum += verify::furnace_radiance(edges);
    CHECK(is_close(sum, verify::furnace_radiance_up_to(edges), 1e-12));
  }
  CHECK(is_close(sum, verify::furnace_radiance_up_to(-1), 1e-10));
  CHECK(is_close(verify::furnace_radiance_up_to(-1), {4, 2, 4 / 3.}, 1e-12));
}

// Independent of how the mean is computed: by the midpoint rule, over points where the camera's rays meet the
// ball.
TEST_CASE("glossy furnace: the radiance is the mean over the image, which the ball fills") {
  const scene::Scene scene = verify::glossy_furnace();
  const scene::Camera& camera = scene.camera;
  const scene::Sphere& ball = scene.spheres.at(1);
  const scene::Material& material = scene.materials.at(1);
  const verify::Model model = verify::model_of(material);
  const Rgb albedo = scene.materials.at(0).value("reflectance");
  constexpr int points = 64;
  Rgb sum(0);
  for (int y = 0; y < points; ++y)
    for (int x = 0; x < points; ++x) {
      const auto place = [](int i) { return 2 * (i + 0.5) / points - 1; };
      const verify::Direction ray = glm::normalize(
          camera.forward + camera.tan_half_fov_x * (place(x) * camera.left + place(y) * camera.up));
      const verify::Direction to_ball = ball.center - camera.position;
      const double middle = glm::dot(ray, to_ball);
      const double half_chord2 = ball.radius * ball.radius - glm::dot(to_ball, to_ball) + middle * middle;
      REQUIRE(half_chord2 > 0);
      const verify::Direction normal =
          (camera.position + (middle - std::sqrt(half_chord2)) * ray - ball.center) / ball.radius;
      const double lobe = verify::lobe_reflectivity(model.exponent, std::acos(-glm::dot(ray, normal)));
      sum += 1.0 + (model.diffuse + model.specular * lobe) * (1.0 + albedo);
    }
  CHECK(is_close(sum / (1. * points * points), verify::glossy_furnace_radiance(), 1e-4));
}

TEST_CASE("integrators: methods and techniques have distinct names, and functions of their own") {
  for (const verify::Method& method : verify::methods()) CHECK(verify::find_method(method.name) == &method);
  CHECK(verify::find_method("exact") == nullptr);
  CHECK(verify::techniques_of(3) == std::vector<film::Technique>{{0, 4}, {1, 3}, {2, 2}, {3, 1}});
  CHECK(verify::technique_of("s2-t2") == film::Technique{2, 2});
  CHECK_FALSE(verify::technique_of("furnace"));
  CHECK(verify::is_length("1 edge"));
}

// A wrong random number in the roulette of connections loses light along paths of 5 edges or more.
TEST_CASE("integrators: a loss of half a percent in bidir is found, and a remedy", "[slow]") {
  const KernelCopy wrong("transport/bidir.cl",
                         "return uniform_real(further_word(pair->word, pair->step, number)) < ",
                         "return uniform_real(further_word(pair->word, pair->step, number)) + "
                         "(connection_probability(pair) < 1.0f ? 0.01f : 0.0f) < ");
  verify::Report report = run({"bidir"}, true, sources::KernelFiles(wrong.folder()));
  CHECK(failures(report) == std::vector<std::string>{"bidir balance furnace"}); // and no technique
  const auto failed = std::ranges::find(report.results(), false, &verify::Result::passed);
  REQUIRE(failed != report.results().end());
  CHECK(failed->note.starts_with("it shows with paths of ")); // 5 or more, if the loss is significant there
  CHECK(failed->note.ends_with("; `connections` 0 is right"));
  CHECK(failed->look_at == "take_pairs (kernels/transport/bidir.cl)");
  const std::vector<std::string> lines = verify::integrators_not_to_use(report);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].starts_with("do not use `integrator` bidir on this device: the furnace is 0."));
  CHECK(lines[0].find("too dark") != std::string::npos);
}
