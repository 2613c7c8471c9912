// The material of a scene with several models: each is loaded from its own record.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "device_test.h"
#include "material_test.h"
#include "temporary_folder.h"

using namespace device_test;

namespace {

// Diffuse, with more parameters than the modified Phong model has words: one of them is in the place of its
// table index.
constexpr const char* many_text = R"(#include "lobes/lobe.h"
#define MANY_PARAMETERS(COLOUR, NUMBER) \
  COLOUR(a, 0.5, 0, 1, "") COLOUR(b, 0.5, 0, 1, "") COLOUR(c, 0.5, 0, 1, "") COLOUR(d, 0.5, 0, 1, "") \
  COLOUR(e, 0.5, 0, 1, "") COLOUR(f, 0.5, 0, 1, "")
LOBE_STRUCT(Many, MANY)
static inline LobeValue many_evaluate(Many m, Vec3 fixed, Vec3 generated) {
  LobeValue v;
  v.value = vec_scale((Real)(INV_PI), m.f);
  v.density = larger(generated.z, (Real)(0.0f)) * INV_PI;
  v.reverse = larger(fixed.z, (Real)(0.0f)) * INV_PI;
  return v;
}
static inline LobeSample many_sample(Many m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  const Vec3 direction = cosine_direction(uniform_real(random.words.y), uniform_real(random.words.z));
  return lobe_sample(direction, many_evaluate(m, fixed, direction));
}
static inline Vec3 many_reflectivity(Many m, Vec3 fixed) { return m.f; }
)";

phlux::scene::Material many() {
  const TemporaryFolder folder;
  folder.write("many.cl", many_text);
  phlux::lobes::Library library;
  library.add(folder / "many.cl");
  phlux::scene::Material material;
  material.model = library.find("many");
  material.values.assign(6, phlux::scene::Rgb(0.5));
  return material;
}

} // namespace

TEST_CASE("materials: a model with more parameters than the Phong model stands beside it") {
  const auto glossy = phong({.4, .3, .2}, {.5, .4, .3}, 10);
  const glm::dvec3 fixed(0.6, 0, 0.8), generated(-0.48, 0.6, 0.64);
  for (const Variant v : {Variant{1}, Variant{8}}) {
    CAPTURE(v);
    const auto alone = device_model(v, {glossy}, "exact"), both = device_model(v, {glossy, many()}, "exact");
    CHECK(both.evaluate(0, {{fixed, generated}})[0].density ==
          alone.evaluate(0, {{fixed, generated}})[0].density);
    // Lanes of a model without a table also read the table of the Phong model, and must stay within it.
    CHECK(both.evaluate(1, {{fixed, generated}})[0].density == Approx(0.64 / std::numbers::pi).epsilon(1e-6));
    CHECK(both.evaluate(1, {{fixed, generated}})[0].value.y == Approx(0.5 / std::numbers::pi).epsilon(1e-6));
  }
}

// The reflectance of unpolarized light for the sines of the angles of incidence and refraction (Fresnel): the
// mean of sin^2(a - b) / sin^2(a + b) and tan^2(a - b) / tan^2(a + b).
static double fresnel(double sine, double bent) {
  if (sine == bent && sine > 0) return 0; // equal media
  const double a = std::asin(sine), b = std::asin(bent);
  const double s = std::sin(a - b) / std::sin(a + b), p = std::tan(a - b) / std::tan(a + b);
  return (s * s + p * p) / 2;
}

// Within 4.5 standard errors: 66 shares, false alarm 5e-4.
TEST_CASE("materials: a dielectric bends light by Snell's law from either side, and equal media do not") {
  for (const Variant v : {Variant{1}, Variant{16}})
    for (const double index : {1.5, 0.7, 1.0}) {
      const auto model = device_model(v, {phlux::lobes::dielectric(index)}, "exact");
      for (const double side : {1.0, -1.0})
        for (const double sine : {1e-4, 1e-3, 0.3, 0.66, 0.9, 0.99999}) {
          CAPTURE(v, index, side, sine);
          const glm::dvec3 fixed(0.6 * sine, 0.8 * sine, side * std::sqrt(1 - sine * sine));
          const double bent = sine * (side > 0 ? 1 / index : index); // of the refracted direction
          int through = 0;
          for (const Sample& s : model.sample(0, fixed, 400, 7, false)) {
            CHECK(s.delta);
            CHECK(s.weight.x == 1);
            const bool reflected = s.direction.z * side > 0;
            through += reflected ? 0 : 1;
            const double scale = reflected ? -1 : -bent / std::max(sine, 1e-30);
            CHECK(s.direction.x == Approx(scale * fixed.x).margin(1e-7));
            CHECK(s.direction.y == Approx(scale * fixed.y).margin(1e-7));
          }
          const double transmitted = bent < 1 ? 1 - fresnel(sine, bent) : 0;
          CHECK(std::abs(through / 400.0 - transmitted) <=
                4.5 * std::sqrt(transmitted * (1 - transmitted) / 400) + 1e-6);
        }
    }
}
