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
    const bool two_sided = draft_.structure.chance(0.4);
    const std::string id = fmt::format("id=\"material{}\"", i);
    if (two_sided) draft_.text.open("bsdf", "type=\"twosided\" " + id);
    lobes(draft_.structure.pick({"diffuse", "diffuse", "phong", "phong", "phong", "anisotropicphong"}),
          two_sided ? "" : " " + id);
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

double RandomMaterials::exponent() {
  const auto drawn = [&] {
    if (draft_.values.chance(0.1)) return 0.0;
    if (draft_.values.chance(0.1)) return most_exponent_;
    return draft_.values.log_uniform(tiny_exponent, most_exponent_);
  }();
  return draft_.twin ? std::min(drawn, draft_.twin->most_exponent) : drawn;
}

} // namespace phlux::test
