#include "random/random_materials.h"

#include <algorithm>

#include <fmt/format.h>

namespace phlux::test {

using scene::Rgb;

namespace {

constexpr double tiny_exponent = 0.1; // lower limit of exponents drawn uniformly in their logarithm

}

RandomMaterials::RandomMaterials(SceneDraft& draft, double most_exponent)
    : draft_(draft), most_exponent_(most_exponent) {}

void RandomMaterials::write() {
  count_ = 2 + draft_.structure.below(3);
  for (int i = 0; i < count_; ++i) {
    const bool polished =
        draft_.structure.chance(0.12); // or rough: with a surface that Fresnel's equations describe
    const std::string type =
        polished
            ? draft_.structure.pick({"conductor", "dielectric", "thindielectric", "plastic", "roughconductor",
                                     "roughdielectric", "roughplastic"})
            : draft_.structure.pick({"diffuse", "diffuse", "phong", "phong", "phong", "anisotropicphong"});
    const bool two_sided = draft_.structure.chance(0.4) && !type.ends_with("dielectric");
    const std::string id = fmt::format("id=\"material{}\"", i);
    if (two_sided) draft_.text.open("bsdf", "type=\"twosided\" " + id);
    if (polished)
      fresnel(type, two_sided ? "" : " " + id);
    else
      lobes(type, two_sided ? "" : " " + id);
    if (two_sided) draft_.text.close("bsdf");
  }
}

void RandomMaterials::refer_to_one() {
  draft_.text.line(fmt::format("<ref id=\"material{}\"/>", draft_.structure.below(count_)));
}

void RandomMaterials::lobes(const std::string& type, const std::string& id) {
  RandomNumbers &structure = draft_.structure, &values = draft_.values;
  SceneText& text = draft_.text;
  text.open("bsdf", fmt::format("type=\"{}\"{}", type, id));
  const bool black = structure.chance(0.08), no_diffuse = structure.chance(0.15);
  const bool grey = values.chance(0.3);
  Rgb diffuse, specular;
  for (int c = 0; c < 3; ++c) {
    const double total = black ? 0 : values.uniform(0.1, 0.99);
    const double share = no_diffuse ? 1 : values.uniform();
    diffuse[c] = grey && c > 0 ? diffuse[0] : total * (1 - share);
    specular[c] = grey && c > 0 ? specular[0] : total * share;
  }
  if (type == "diffuse") {
    text.color("reflectance", diffuse + specular);
  } else {
    if (values.chance(0.1) && !black) { // as Mitsuba scales it
      text.boolean("ensure_energy_conservation", true);
      diffuse *= 1.5;
      specular *= 1.5;
    }
    text.color("diffuse_reflectance", diffuse);
    text.color("specular_reflectance", specular);
    if (type == "phong") {
      text.real("exponent", exponent());
    } else {
      text.real("exponent_u", exponent());
      text.real("exponent_v", exponent());
    }
  }
  text.close("bsdf");
}

void RandomMaterials::fresnel(const std::string& type, const std::string& id) {
  RandomNumbers& values = draft_.values;
  SceneText& text = draft_.text;
  const auto colour = [&](double lowest, double highest) { return triple(values, lowest, highest); };
  text.open("bsdf", fmt::format("type=\"{}\"{}", type, id));
  const bool metal = type.ends_with("conductor"), rough = type.starts_with("rough");
  if (metal && values.chance(0.5)) {
    text.string("material", values.pick({"Au", "Cu", "Al", "none"}));
  } else if (metal) {
    text.color("eta", colour(0.1, 3));
    text.color("k", colour(0, 4));
  } else if (values.chance(0.5)) {
    text.string("int_ior", "water");
  } else {
    text.real("int_ior", values.uniform(1.2, 2.4));
  }
  if (values.chance(0.5)) text.color("specular_reflectance", colour(0.5, 1));
  if (type.ends_with("dielectric")) text.color("specular_transmittance", colour(0.5, 1));
  if (type.ends_with("plastic")) {
    text.color("diffuse_reflectance", colour(0, 1));
    text.boolean("nonlinear", values.chance(0.5));
  }
  if (rough) {
    text.real("alpha", values.uniform(0.2, 1));
    text.string("distribution", values.pick({"beckmann", "ggx", "phong"}));
  }
  text.close("bsdf");
}

double RandomMaterials::exponent() {
  const auto drawn = [&] {
    if (draft_.values.chance(0.1)) return 0.0;
    if (draft_.values.chance(0.1)) return most_exponent_;
    return draft_.values.log_uniform(tiny_exponent, most_exponent_);
  }();
  return draft_.twin ? std::min(drawn, draft_.twin->most_exponent) : drawn;
}

} // namespace phlux::test
