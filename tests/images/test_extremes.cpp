// Scenes of scenes/stability with extreme sizes, powers, shapes and films.
#include <random>

#include <catch2/catch.hpp>

#include "images/evidence.h"
#include "images/stability.h"
#include "phong/reflectivity.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;
using scene::Vec3;

namespace {

// The image in another unit of radiance.
Estimate scaled(Estimate image, double factor) {
  for (std::size_t i = 0; i < image.mean.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      image.mean[i][c] *= factor;
      image.variance[i][c] *= factor * factor;
    }
  return image;
}

} // namespace

TEST_CASE("rooms of 1e-4 and 1e4 units, 1e5 from the origin, and lamps of 1e-8 and 1e8 W give one image") {
  const Estimate reference = image_by(path, stability("extremes"), 512, 1000);
  const std::pair<Definitions, double> variants[] = {
      {{{"scale", "1e-4"}, {"inverse", "1e4"}}, 1},
      {{{"scale", "1e4"}, {"inverse", "1e-4"}}, 1},
      {{{"x", "1e5"}, {"y", "-1e5"}, {"z", "1e5"}}, 1},
      {{{"power", "1e-8"}}, 40 / 1e-8},
      {{{"power", "1e8"}}, 40 / 1e8},
  };
  std::uint64_t seed = 2000;
  for (const auto& [definitions, factor] : variants)
    for (const Method& method : {path, light, bidir}) {
      CAPTURE(definitions, name_of(method));
      const Estimate image = image_by(method, stability("extremes", definitions), 128, ++seed);
      check_tiles(scaled(image, factor), reference);
    }
}

TEST_CASE("floor and light of needle triangles look like rectangles") {
  const scene::Scene needles = stability("slivers");
  scene::Scene rectangles = needles;
  rectangles.meshes.clear();
  rectangles.patches.push_back(square({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1, needles.meshes[0].surface));
  rectangles.patches.push_back(square({0, 1.9, 0}, {1, 0, 0}, {0, 0, 1}, 0.3, needles.meshes[1].surface));
  const Estimate reference = image_by(path, rectangles, 512, 1000);
  for (const Method& method : {path, bidir}) {
    CAPTURE(name_of(method));
    render::Settings settings = settings_with_seed(method, 128, 2000);
    settings.traversal = render::Traversal::bvh;
    const Render render = render_of(needles, settings);
    CHECK(render.statistics.nonfinite == 0);
    CHECK(relative_error(estimate_of(render.film), reference) < 0.03);
    check_tiles(estimate_of(render.film), reference);
  }
}

// Gaps between two triangles would show what is below.
TEST_CASE("nothing shines through a floor of needle triangles") {
  scene::Scene scene = stability("slivers");
  scene.patches.push_back(square({0, -0.5, 0}, {0, 0, 1}, {1, 0, 0}, 3, scene.meshes[1].surface));
  scene.camera = look_at({0.1, 0.9, 0.2}, {0.05, 0, 0.1}, 60, scene.camera.width, scene.camera.height);
  render::Settings settings = settings_with_seed(path, 4096, 1);
  settings.traversal = render::Traversal::bvh;
  settings.max_depth = 1;
  CHECK(mean_of(estimate_of(render_of(scene, settings).film)) == 0);
  scene.meshes[0].triangles.pop_back();
  CHECK(mean_of(estimate_of(render_of(scene, settings).film)) > 0);
}

namespace {

// As in million_lights.py.
void scatter_lights(scene::Mesh& mesh, int side) {
  constexpr double edge = 0.15;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> place(0, 1 - edge);
  mesh.positions.clear();
  mesh.triangles.clear();
  mesh.normals.clear(); // those of the one triangle
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const Vec3 corner(column - side / 2 + place(generator), 1, row - side / 2 + place(generator));
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(),
                            {corner, corner + Vec3(edge, 0, 0), corner + Vec3(0, 0, edge)});
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
}

} // namespace

TEST_CASE(
    "among a million lights a light sample by power finds the near ones by chance, by contribution at once") {
  const TemporaryFolder mesh;
  mesh.write("one.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                        "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                        "end_header\n0 1 0\n1 1 0\n0 1 1\n3 0 1 2\n");
  scene::Scene scene = stability("million-lights", {{"lights", (mesh / "one.ply").string()}});
  scatter_lights(scene.meshes.at(0), 1000);
  const Estimate by_contribution = image_by(path_light_samples, scene, 64, 1);
  render::Settings by_power = settings_with_seed(path_light_samples, 512, 2);
  by_power.light_selection = render::LightSelection::power;
  const film::Film samples = render_of(scene, by_power).film;
  // A sky of equal irradiance. The tolerance is for the reflectance and the random places of the lights.
  const double sky = 0.5 * 0.15 * 0.15 * 100;
  const Estimate reference = expected(
      scene.camera,
      [&](const Vec3& direction) {
        const double lobe = 0.1 * phong::lobe_reflectivity(10, -direction.y);
        return Channels{sky * (0.6 + lobe), 0.9 * sky * (0.55 + lobe), 0.7 * sky * (0.5 + lobe)};
      },
      4);
  CHECK(mean_of(by_contribution) == Approx(mean_of(reference)).epsilon(0.1));
  CHECK(relative_error(by_contribution, reference) < 0.25);
  CHECK(relative_error(estimate_of(samples), reference) > 0.4);
  check_verdict(samples, false);
}

namespace {

// Means over runs of pixels in an image one pixel wide or high.
Estimate strip(const Estimate& image, int run) {
  const auto pixels = static_cast<double>(run);
  Estimate result = closed_form(static_cast<int>(image.mean.size()) / run, 1, {});
  result.mean.resize(static_cast<std::size_t>(result.width));
  result.variance.resize(result.mean.size());
  for (std::size_t i = 0; i < image.mean.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      result.mean[i / static_cast<std::size_t>(run)][c] += image.mean[i][c] / pixels;
      result.variance[i / static_cast<std::size_t>(run)][c] += image.variance[i][c] / pixels / pixels;
    }
  return result;
}

} // namespace

TEST_CASE("films of one pixel, one column and one row") {
  const std::tuple<const char*, const char*, int> films[] = {
      {"1", "1", 65536}, {"1", "16384", 16}, {"16384", "1", 16}};
  for (const auto& [width, height, samples] : films) {
    const scene::Scene scene =
        stability("extremes", {{"width", width}, {"height", height}, {"fovAxis", "larger"}});
    const int run = samples > 16 ? 1 : 256;
    const Estimate reference = strip(image_by(path, scene, samples, 1000), run);
    for (const Method& method : {light, bidir}) {
      CAPTURE(width, height, name_of(method));
      const Estimate image = strip(image_by(method, scene, samples, 2000), run);
      if (run > 1 && method.integrator == "light") continue; // few light paths reach such a narrow film
      check_agreement_of_pixels(image, reference);
    }
  }
}
