// Lookups of textures against a reference in float64, and the parametrization of each shape.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>

#include "lobes/assignment.h"
#include "lobes/models.h"
#include "scene_test.h"

using namespace device_test;
using phlux::scene::Rgb;
using phlux::scene::Scene;
using phlux::scene::TexelImage;
using phlux::scene::Texture;
using phlux::scene::Vec3;
using Wrap = Texture::Wrap;

namespace {

struct Point {
  float u, v;
};
struct Colour {
  float r, g, b;
};

std::shared_ptr<const TexelImage> image(int width, int height, bool bytes) {
  std::mt19937 random(7);
  TexelImage result;
  result.width = width;
  result.height = height;
  for (std::size_t i = 0; i < 256; ++i) result.decoded[i] = std::pow(static_cast<float>(i) / 255, 2.2F);
  for (int i = 0; i < width * height; ++i)
    for (int channel = 0; channel < (bytes ? 4 : 3); ++channel) {
      if (bytes)
        result.bytes.push_back(static_cast<std::uint8_t>(random() & 255));
      else
        result.floats.push_back(static_cast<float>(random()) * 0x1p-33F);
    }
  result.largest = Rgb(1);
  return std::make_shared<const TexelImage>(std::move(result));
}

// Texel (x, y) anywhere, as the wrap modes repeat it.
int wrapped(int x, int size, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(x, 0, size - 1);
  const int period = wrap == Wrap::repeat ? size : 2 * size;
  const int within = (x % period + period) % period;
  return within < size ? within : 2 * size - 1 - within;
}
Rgb texel(const Texture& texture, int x, int y) {
  const TexelImage& from = *texture.image;
  const auto index = static_cast<std::size_t>(wrapped(y, from.height, texture.wrap_v) * from.width +
                                              wrapped(x, from.width, texture.wrap_u));
  Rgb rgb;
  for (int c = 0; c < 3; ++c) {
    const auto channel = static_cast<std::size_t>(c);
    rgb[c] = static_cast<double>(from.bytes.empty() ? from.floats[3 * index + channel]
                                                    : from.decoded[from.bytes[4 * index + channel]]);
  }
  return rgb * texture.scale;
}

Rgb expected(const Texture& texture, Point at) {
  const auto& m = texture.to_uv;
  const double u = m[0] * static_cast<double>(at.u) + m[1] * static_cast<double>(at.v) + m[2];
  const double v = m[3] * static_cast<double>(at.u) + m[4] * static_cast<double>(at.v) + m[5];
  if (!texture.image)
    return texture.colors[(u - std::floor(u) > 0.5) == (v - std::floor(v) > 0.5) ? 0 : 1] * texture.scale;
  const double x = u * texture.image->width, y = v * texture.image->height;
  const auto texel_of = [](double position) { return static_cast<int>(std::floor(position)); };
  if (texture.nearest) return texel(texture, texel_of(x), texel_of(y));
  const int left = texel_of(x - 0.5), top = texel_of(y - 0.5);
  const double along = x - 0.5 - left, down = y - 0.5 - top;
  return (1 - down) * ((1 - along) * texel(texture, left, top) + along * texel(texture, left + 1, top)) +
         down * ((1 - along) * texel(texture, left, top + 1) + along * texel(texture, left + 1, top + 1));
}

// Near an edge of texels or squares, rounding decides.
bool near_edge(const Texture& texture, Point at) {
  constexpr float least = 1e-4F;
  const Rgb here = expected(texture, at);
  for (const float du : {-least, least})
    for (const float dv : {-least, least})
      if (glm::length(expected(texture, {at.u + du, at.v + dv}) - here) > 0.05) return true;
  return false;
}

std::vector<Texture> textures() {
  std::vector<Texture> list;
  for (const bool bytes : {true, false}) {
    const auto texels = image(5, 3, bytes);
    for (const Wrap u : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
      for (const bool nearest : {true, false}) {
        Texture& texture = list.emplace_back();
        texture.image = texels;
        texture.wrap_u = u;
        texture.wrap_v = u == Wrap::clamp ? Wrap::mirror : Wrap::clamp;
        texture.nearest = nearest;
        texture.scale = 0.5;
        texture.to_uv = {0.9, 0.2, -0.3, -0.4, 0.8, 0.1};
      }
  }
  list.emplace_back().image = image(1, 1, true);
  list.emplace_back().colors = {Rgb(.1, .2, .3), Rgb(.9, .8, .7)};
  list.emplace_back().to_uv = {3, 1, .2, -2, 2, .7};
  return list;
}

// A scene that has the textures.
Scene scene_of(const std::vector<Texture>& list) {
  Scene scene;
  for (const Texture& texture : list) {
    phlux::scene::Material& material = scene.materials.emplace_back(phlux::lobes::diffuse(Rgb(0)));
    material.set_texture(0, std::make_shared<const Texture>(texture));
    scene.patches.emplace_back().surface.material = static_cast<int>(scene.materials.size()) - 1;
  }
  scene.constant_radiance = Rgb(1);
  return scene;
}

struct RayArgument {
  glm::vec3 origin, direction;
};
struct Mapped {
  float u, v;
  glm::vec3 tangent;
};

struct Reflection {
  std::array<float, 11> words; // value, direction, weight, densities
};

Mapped mapped(const SceneProgram& program, const Vec3& origin, const Vec3& target) {
  const std::vector<RayArgument> rays{
      {glm::vec3(origin - program.host().geometry->origin), glm::vec3(glm::normalize(target - origin))}};
  std::vector<Mapped> found(1);
  program.run("map", 1, rays, out(found));
  return found[0];
}

} // namespace

TEST_CASE("textures: lookups agree with a reference, inside [0, 1] and outside") {
  const std::vector<Texture> list = textures();
  const Scene scene = scene_of(list);
  std::mt19937 random(1);
  std::vector<int> numbers;
  std::vector<Point> points;
  for (std::size_t i = 0; i < thinned(4000); ++i) {
    numbers.push_back(static_cast<int>(random() % list.size()));
    const auto coordinate = [&] { return (static_cast<float>(random()) * 0x1p-32F - 0.5F) * 8; };
    points.push_back({coordinate(), coordinate()});
  }
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<Colour> colours(points.size());
    SceneProgram(v, "textures.cl", scene).run("look_up", points.size(), numbers, points, out(colours));
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Texture& texture = list[static_cast<std::size_t>(numbers[i])];
      if ((texture.nearest || !texture.image) && near_edge(texture, points[i])) continue;
      const Rgb is(colours[i].r, colours[i].g, colours[i].b);
      const double error = glm::length(is - expected(texture, points[i]));
      if (error > worst) worst = error;
    }
    CHECK(worst < 1e-5); // of float32 coordinates up to 4, times five texels
  }
}

TEST_CASE("textures: coordinates that are not finite read no memory outside the image") {
  const Scene scene = scene_of(textures());
  const std::vector<Point> points{{NAN, 0}, {INFINITY, -INFINITY}, {1e30F, -1e30F}, {-1e-9F, 1}};
  for (const Variant v : {Variant{1}, Variant{16}})
    for (int number = 0; number < static_cast<int>(scene.materials.size()); ++number) {
      std::vector<Colour> colours(points.size());
      SceneProgram(v, "textures.cl", scene)
          .run("look_up", points.size(), std::vector<int>(points.size(), number), points, out(colours));
      CHECK(std::isfinite(colours[3].r));
    }
}

// A shipped model whose derived members depend on colours and that does not compute them anew fails here.
TEST_CASE("textures: of each model, a texture reflects as the constant colours that it has there") {
  Scene scene;
  scene.constant_radiance = Rgb(1);
  const std::array<Rgb, 2> colors{Rgb(.3, .2, .1), Rgb(.05, .1, .45)};
  const phlux::lobes::Library library;
  for (const auto& model : library.models()) {
    phlux::scene::Material textured = phlux::lobes::default_material(model);
    std::array<phlux::scene::Material, 2> constant{textured, textured};
    for (std::size_t i = 0; i < model->parameters.size(); ++i) {
      if (model->parameters[i].kind != phlux::scene::Parameter::Kind::colour) continue;
      Texture squares;
      squares.colors = colors;
      squares.scale = 1.0 / static_cast<double>(i + 1);
      textured.set_texture(i, std::make_shared<const Texture>(squares));
      for (std::size_t k = 0; k < 2; ++k) constant[k].values[i] = squares.scale * colors[k];
    }
    for (const auto& material : {textured, constant[0], constant[1]}) {
      scene.materials.push_back(material);
      scene.patches.emplace_back().surface.material = static_cast<int>(scene.materials.size()) - 1;
    }
  }
  std::vector<int> textured, constant;
  std::vector<Point> at;
  std::vector<glm::vec3> fixed, generated;
  const glm::vec3 directions[] = {{0, 0.6F, 0.8F}, {-0.48F, 0.6F, 0.64F}, {0.28F, 0, 0.96F}};
  for (int model = 0; model < static_cast<int>(library.models().size()); ++model)
    for (const glm::vec3& one : directions)
      for (const glm::vec3& other : directions)
        for (const int square : {0, 1}) {
          textured.push_back(3 * model);
          constant.push_back(3 * model + 1 + square);
          at.push_back({square == 0 ? 0.25F : 0.75F, 0.25F});
          fixed.push_back(one);
          generated.push_back(other);
        }
  for (const Variant v : {Variant{1}, Variant{16}}) {
    const SceneProgram program(v, "textures.cl", scene);
    std::vector<Reflection> is(at.size()), expected(at.size());
    program.run("reflect", at.size(), textured, at, fixed, generated, out(is));
    program.run("reflect", at.size(), constant, at, fixed, generated, out(expected));
    for (std::size_t i = 0; i < at.size(); ++i) {
      CAPTURE(v, textured[i], constant[i], i);
      for (std::size_t word = 0; word < is[i].words.size(); ++word)
        CHECK(is[i].words[word] == Approx(expected[i].words[word]).epsilon(1e-5));
    }
  }
}

TEST_CASE("textures: shapes are parametrized as in Mitsuba") {
  constexpr double turn = 2 * std::numbers::pi;
  Scene scene = scene_of({Texture{}});
  scene.materials.push_back(phlux::lobes::anisotropic_phong(Rgb(.1), Rgb(.1), 10, 20)); // tangents
  phlux::scene::Patch& flat = scene.patches[0];
  flat.origin = {0, 0, -5};
  flat.uv = {glm::dvec2(.25, .5), glm::dvec2(0, .25), glm::dvec2(-.125, 0)};
  phlux::scene::Patch disk;
  disk.region = phlux::scene::Patch::Region::ellipse;
  disk.origin = {5, 0, 0};
  disk.uv = {glm::dvec2(0.0), glm::dvec2(1, 0), glm::dvec2(0, 1)};
  scene.patches.push_back(disk);
  phlux::scene::Sphere sphere;
  sphere.center = {-5, 0, 0};
  sphere.radius = 2;
  sphere.axes = {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  scene.spheres = {sphere, {{-20, 0, 0}, 1, false, {1, -1}}};
  phlux::scene::Mesh mesh;
  mesh.positions = {{0, 3, 0}, {2, 3, 0}, {0, 5, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.texture_coordinates = {{0, 0}, {0, 1}, {1, 0}};
  scene.meshes.push_back(mesh);
  for (const Variant v : variants) {
    CAPTURE(v);
    const SceneProgram program(v, "textures.cl", scene);
    const Mapped on_flat = mapped(program, {.5, -.25, 0}, {.5, -.25, -5});
    CHECK(on_flat.u == Approx(.25 + .125 * .25));
    CHECK(on_flat.v == Approx(.5 + .25 * .5));
    CHECK(on_flat.tangent.y == Approx(-1));
    const Mapped on_disk = mapped(program, {5.3, -.4, 1}, {5.3, -.4, 0});
    CHECK(on_disk.u == Approx(.5));
    CHECK(on_disk.v == Approx(1 - std::atan2(.4, .3) / turn));
    CHECK(on_disk.tangent.x == Approx(.6)); // along the radius
    CHECK(on_disk.tangent.y == Approx(-.8));
    // In the axes of the object the direction is (z, x, y).
    const Vec3 d = glm::normalize(Vec3(.3, .8, -.5));
    const Mapped on_sphere = mapped(program, sphere.center + 4.0 * d, sphere.center);
    CHECK(on_sphere.u == Approx(std::atan2(d.x, d.z) / turn + (std::atan2(d.x, d.z) < 0 ? 1 : 0)));
    CHECK(on_sphere.v == Approx(std::acos(d.y) / std::numbers::pi));
    const Vec3 along = glm::normalize(Vec3(d.z, 0, -d.x));
    CHECK(on_sphere.tangent.x == Approx(along.x).margin(1e-6));
    CHECK(on_sphere.tangent.z == Approx(along.z).margin(1e-6));
    const Mapped on_pole =
        mapped(program, sphere.center + Vec3(1e-3, 4, 0), sphere.center + Vec3(1e-3, 0, 0));
    CHECK(on_pole.v == Approx(5e-4 / std::numbers::pi).epsilon(1e-3));
    const Mapped on_mesh = mapped(program, {.5, 4, 1}, {.5, 4, 0});
    CHECK(on_mesh.u == Approx(.5));
    CHECK(on_mesh.v == Approx(.25));
    CHECK(on_mesh.tangent.y == Approx(1)); // u grows along +y
  }
}
