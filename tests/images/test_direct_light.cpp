// Point, spot and directional lights over a plane: the irradiance is known at every point.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "images/evidence.h"
#include "images/scenes.h"
#include "materials.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;
using scene::Vec3;

namespace {

constexpr double pi = std::numbers::pi;
const Vec3 eye(0.1, -0.3, 1);

// The plane z = 0, larger than the view.
scene::Scene plane(const scene::Material& material) {
  scene::Scene scene;
  scene.materials = {material};
  scene.patches = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 5, {})};
  scene.camera = look_at(eye, {0.1, -0.29, 0}, 60, 12, 12);
  return scene;
}

// Modified Phong at the plane, from the formula: f_r for directions to the light and to the eye.
Rgb reflectance(const scene::Material& m, const Vec3& wi, const Vec3& wo) {
  const Vec3 mirrored(-wi.x, -wi.y, wi.z);
  const double cosine = std::max(0.0, glm::dot(mirrored, wo));
  return phlux::test::diffuse_of(m) / pi + phlux::test::specular_of(m) * (phlux::test::exponent_of(m) + 2) /
                                               (2 * pi) * std::pow(cosine, phlux::test::exponent_of(m));
}

// What the camera sees of the plane when light of intensity(direction away from the light) comes from
// `light`.
template<class Intensity>
Estimate lit_from(const scene::Scene& scene, const Vec3& light, Intensity intensity, int points = 32) {
  return expected(
      scene.camera,
      [&](const Vec3& direction) {
        const Vec3 point = eye - eye.z / direction.z * direction;
        const Vec3 way = light - point;
        const double distance2 = glm::dot(way, way);
        const Vec3 wi = way / std::sqrt(distance2);
        const Rgb radiance =
            reflectance(scene.materials[0], wi, -direction) * intensity(-wi) * wi.z / distance2;
        return Channels{radiance.r, radiance.g, radiance.b};
      },
      points);
}

const scene::Material glossy = phong({0.5, 0.3, 0.1}, {0.3, 0.1, 0.6}, 20);

} // namespace

TEST_CASE("a point light on a glossy plane") {
  scene::Scene scene = plane(glossy);
  scene.point_lights = {{{0.3, -0.2, 1.5}, {3, 2, 1}}};
  const Estimate image = estimate_of(render_of(scene, settings_for(512, 2)).film);
  check_agreement(image, lit_from(scene, {0.3, -0.2, 1.5}, [](const Vec3&) { return Rgb(3, 2, 1); }));
}

TEST_CASE("a spot light: full in its beam, fading to its cutoff, nothing outside") {
  const Vec3 position(0.1, -0.3, 0.9), axis = glm::normalize(Vec3(0.1, 0.2, -1));
  const double cutoff = 28 * pi / 180;
  for (const double beam : {12 * pi / 180, cutoff}) {
    CAPTURE(beam);
    scene::Scene scene = plane(diffuse({0.8, 0.5, 0.2}));
    scene.spot_lights = {{position, axis, {3, 2, 1}, cutoff, beam}};
    const auto intensity = [&](const Vec3& away) {
      const double angle = std::acos(std::min(1.0, glm::dot(axis, away)));
      if (angle <= beam) return Rgb(3, 2, 1);
      return angle >= cutoff ? Rgb(0.0) : Rgb(3, 2, 1) * ((cutoff - angle) / (cutoff - beam));
    };
    const Estimate image = estimate_of(render_of(scene, settings_for(512, 2)).film);
    // Pixels on the sharp edge of a beam as wide as its cone: the error of the midpoint rule is 1 / points
    // there.
    const bool sharp = beam == cutoff;
    check_agreement(image, lit_from(scene, position, intensity, sharp ? 256 : 64), sharp ? 2e-3 : 2e-4);
    CHECK(image.mean.front() == Channels{});
    CHECK(image.mean[6 * 12 + 6][0] > 0);
  }
}

TEST_CASE("a spot light narrower than a degree has its flux by every integrator") {
  const std::string integrator = GENERATE("path", "light", "bidir");
  for (const double degrees : {0.5, 0.05, 0.01}) {
    CAPTURE(integrator, degrees);
    const double cutoff = degrees * pi / 180;
    const Vec3 position(0, -2, 0);
    scene::Scene scene;
    scene.materials = {diffuse(Rgb(0.5))};
    scene.patches = {square({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 5, {})};
    scene.camera = look_at(position, {0, 0, 0}, 4 * degrees, 12, 12);
    scene.spot_lights = {{position, Vec3(0, 1, 0), Rgb(8.0), cutoff, cutoff / 2}};
    render::Settings settings = settings_for(2048, 2);
    settings.integrator = integrator;
    const film::Film film = render_of(scene, settings).film;
    double mean = 0;
    for (std::size_t pixel = 0; pixel < 144; ++pixel) mean += film.mean(pixel)[1] / 144;
    // rho / pi I / d^2 times the mean falloff over the image: 7 pi cutoff^2 / 12 of a width of 4 cutoff. The
    // standard error is 0.4% at most: one of the nine cases fails by chance in 1,500 seeds.
    CHECK(mean == Approx(0.5 * 8 / 4 * 7 / 12 / 16).epsilon(0.016));
  }
}

TEST_CASE("a directional light on a plane that it meets at an angle") {
  scene::Scene scene = plane(diffuse({0.8, 0.5, 0.2}));
  scene.directional_lights = {{glm::normalize(Vec3(1, 2, -2)), {3, 2, 1}}};
  const Render lit = render_of(scene, settings_for(32, 2));
  const double cosine = 2.0 / 3.0;
  check_agreement(estimate_of(lit.film),
                  uniform(lit.film, {0.8 * 3 * cosine / pi, 0.5 * 2 * cosine / pi, 0.2 * cosine / pi}));
}

TEST_CASE("lights without extent behind the plane do not shine through it") {
  scene::Scene scene = plane(glossy);
  scene.point_lights = {{{0.3, -0.2, -1.5}, {3, 2, 1}}};
  scene.directional_lights = {{{0, 0, 1}, {3, 2, 1}}};
  const Render dark = render_of(scene, settings_for(16));
  for (const film::Pixel& pixel : dark.film.pixels()) CHECK(pixel.sum == Channels{});
}

TEST_CASE("a dim constant sky does not raise the variance of a lamp, nor of the sun") {
  const std::string integrator = GENERATE("path", "bidir");
  scene::Scene lamp = plane(diffuse(Rgb(0.5))), sun = lamp;
  lamp.area_emitters = {{Rgb(8.0)}};
  lamp.patches.push_back(square({0, 0, 2}, {0, 1, 0}, {1, 0, 0}, 1, {0, 0}));
  sun.directional_lights = {{{0, 0, -1}, Rgb(1.0)}};
  for (const scene::Scene& light : {lamp, sun}) {
    render::Settings settings = settings_for(4096, 2);
    settings.integrator = integrator;
    scene::Scene with_sky = light;
    with_sky.constant_radiance = Rgb(1e-4);
    const double alone = render_of(light, settings).film.relative_variance();
    const double beside_sky = render_of(with_sky, settings).film.relative_variance();
    CAPTURE(integrator, alone, beside_sky);
    // Two estimates of one variance from 590,000 samples each; choosing the sky for half of the light samples
    // would double it. By path the sun alone has no variance.
    CHECK(beside_sky <= 1.02 * alone + 1e-5);
  }
}
