// Textured surfaces in closed form; test_integrators.cpp compares the integrators on scenes/textures.xml.
#include <cmath>

#include <catch2/catch.hpp>

#include "images/evidence.h"
#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;
using scene::Vec3;

namespace {

const Vec3 eye(0.2, 0.3, 2);

// The plane z = 0, 10 units wide, whose reflectance is the texture, under a sky of radiance 1: it reflects
// what its reflectance is.
scene::Scene plane_of(const scene::Texture& texture) {
  scene::Scene scene;
  scene.materials = {diffuse(Rgb(0))};
  scene.materials[0].set_texture(0, std::make_shared<const scene::Texture>(texture));
  scene.patches = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 5, {})};
  scene.constant_radiance = Rgb(1);
  scene.camera = look_at(eye, {0.3, 0.31, 0}, 50, 12, 10);
  return scene;
}

// The place where a direction from the eye meets the plane, in texture coordinates.
glm::dvec2 seen(const Vec3& direction) {
  const Vec3 point = eye - eye.z / direction.z * direction;
  return {0.5 + point.x / 10, 0.5 + point.y / 10};
}

void check_plane(const scene::Texture& texture, const std::function<Rgb(const glm::dvec2&)>& reflectance) {
  const scene::Scene scene = plane_of(texture);
  const Estimate exact = expected(
      scene.camera,
      [&](const Vec3& direction) {
        const Rgb rgb = reflectance(seen(direction));
        return Channels{rgb.r, rgb.g, rgb.b};
      },
      64);
  check_agreement(estimate_of(render_of(scene, settings_for(256)).film), exact, 1e-3);
}

} // namespace

TEST_CASE("a checkerboard floor under a white sky has the radiance of its squares") {
  scene::Texture squares;
  squares.colors = {Rgb(.9, .5, .1), Rgb(.2, .4, .6)};
  squares.to_uv = {20, 0, .2, 0, 15, -.4};
  check_plane(squares, [&](const glm::dvec2& at) {
    const double u = 20 * at.x + .2, v = 15 * at.y - .4;
    return squares.colors[(u - std::floor(u) > .5) == (v - std::floor(v) > .5) ? 0 : 1];
  });
}

TEST_CASE("texels seen head-on, in a row across the view") {
  scene::TexelImage row;
  row.width = 8;
  row.height = 1;
  for (int i = 0; i < 8; ++i) row.floats.insert(row.floats.end(), {.1F * static_cast<float>(i), .5F, .8F});
  row.largest = Rgb(.7, .5, .8);
  scene::Texture texels;
  texels.image = std::make_shared<const scene::TexelImage>(row);
  texels.nearest = true;
  texels.to_uv = {2, 0, 0, 0, 1, 0};
  check_plane(texels, [&](const glm::dvec2& at) {
    return Rgb(.1 * (static_cast<int>(std::floor(16 * at.x)) % 8), .5, .8);
  });
  texels.nearest = false;
  check_plane(texels, [&](const glm::dvec2& at) {
    const double x = 16 * at.x - .5, below = std::floor(x);
    const int left = static_cast<int>(below) % 8, right = (left + 1) % 8;
    return Rgb(.1 * (left + (x - below) * (right - left)), .5, .8);
  });
}

namespace {

// The plane under a square lamp, seen vertically from above. The squares of the checkerboard are black and
// grey in every reflectance of the material.
scene::Scene black_and_grey(scene::Material material) {
  scene::Texture squares;
  squares.colors = {Rgb(0), Rgb(0.4)};
  squares.to_uv = {20, 0, 0, 0, 20, 0};
  scene::Scene scene = plane_of(squares);
  const scene::TexturePointer texture = scene.materials[0].textures[0];
  for (const std::size_t reflectance : {0, 1}) material.set_texture(reflectance, texture);
  scene.materials = {material};
  scene.constant_radiance.reset();
  scene.area_emitters = {{Rgb(20)}};
  scene.patches.push_back(square({1, 0.5, 2.5}, {0, 1, 0}, {1, 0, 0}, 0.5, {0, 0}));
  scene.camera = look_at({0, 0, 2}, {0, 0, 0}, 50, 8, 8);
  scene.camera.orthographic = true;
  return scene;
}

} // namespace

TEST_CASE("squares that are black in every part of a model scatter nothing, and no sample is not finite") {
  for (const std::string integrator : {"path", "bidir"}) {
    for (const std::string& strategy : render::strategy_names()) {
      // The integrators share the functions of a strategy; bidir also evaluates densities both ways.
      if (integrator == "bidir" && strategy != "exact" && strategy != "lobe-estimate") continue;
      CAPTURE(integrator, strategy);
      render::Settings settings = settings_for(16, 3);
      settings.integrator = integrator;
      settings.strategy = strategy;
      const Render image = render_of(black_and_grey(phong(Rgb(0.4), Rgb(0.4), 20)), settings);
      CHECK(image.statistics.nonfinite == 0);
      CHECK(image.film.relative_error().variance > 0); // the grey squares are lit
    }
    render::Settings settings = settings_for(16, 3);
    settings.integrator = integrator;
    const Render image =
        render_of(black_and_grey(lobes::anisotropic_phong(Rgb(0.4), Rgb(0.4), 20, 200)), settings);
    CHECK(image.statistics.nonfinite == 0);
  }
}
