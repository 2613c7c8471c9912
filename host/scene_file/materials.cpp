#include "scene_file/materials.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>

#include "scene_file/properties.h"

namespace phlux::scene_file {

namespace {

using scene::Material;
using scene::Rgb;

constexpr const char* supported_bsdfs =
    "supported are diffuse, phong, anisotropicphong and twosided around one of these";
constexpr double default_exponent = 30.0; // these three are Mitsuba's, as are all others in this folder
constexpr double default_diffuse = 0.5;
constexpr double default_specular = 0.2;
/// What Mitsuba leaves of reflectances that it scales down.
constexpr double kept_energy = 0.99;

std::string text(const Rgb& color) {
  return std::to_string(color.r) + " " + std::to_string(color.g) + " " + std::to_string(color.b);
}

Rgb reflectance(Properties& properties, const std::string& name, double otherwise, ExcessEnergy excess) {
  const Rgb color = properties.color(name, Rgb(otherwise));
  if (glm::compMin(color) < 0.0 || (excess == ExcessEnergy::error && glm::compMax(color) > 1.0))
    properties.fail_at(name, "reflectance " + text(color) + " is impossible",
                       "every channel must be in [0, 1]");
  return color;
}

double exponent(Properties& properties, const std::string& name) {
  const double value = properties.real(name, default_exponent);
  if (value < 0.0)
    properties.fail_at(name, std::to_string(value) + " is negative", "an exponent must be 0 or more");
  return value;
}

/// Scales both by .99 / `most`, as Mitsuba does, if `most` (the largest channel of what must stay within 1)
/// exceeds 1.
void conserve_energy(Properties& properties, Material& material, double most, ExcessEnergy excess) {
  if (most <= 1.0) return;
  const Location& where = properties.element().where;
  const std::string wrong =
      properties.element().name() + " reflects " + std::to_string(most) + " times what arrives";
  if (excess == ExcessEnergy::error)
    fail(where, wrong,
         properties.spelling("diffuse_reflectance") + " + " + properties.spelling("specular_reflectance") +
             " must be at most 1 in every channel (ensureEnergyConservation=true scales them down)");
  material.diffuse *= kept_energy / most;
  material.specular *= kept_energy / most;
  warn(where, wrong + "; its reflectances are scaled by " + std::to_string(kept_energy / most));
}

Material read_lobes(Properties& properties, ExcessEnergy excess) {
  Material material;
  const std::string type = properties.element().type();
  if (type == "diffuse") {
    const bool long_name = properties.has("diffuse_reflectance") && !properties.has("reflectance");
    material.diffuse =
        reflectance(properties, long_name ? "diffuse_reflectance" : "reflectance", default_diffuse, excess);
    conserve_energy(properties, material, glm::compMax(material.diffuse), excess);
    return material;
  }
  material.diffuse = reflectance(properties, "diffuse_reflectance", default_diffuse, excess);
  material.specular = reflectance(properties, "specular_reflectance", default_specular, excess);
  if (type == "phong") {
    material.exponent_u = exponent(properties, "exponent");
    conserve_energy(properties, material, glm::compMax(material.diffuse + material.specular), excess);
  } else {
    material.kind = Material::Kind::anisotropic_phong;
    material.exponent_u = exponent(properties, "exponent_u");
    material.exponent_v = exponent(properties, "exponent_v");
    // The model's diffuse term already gives way to the specular one: each alone must stay within 1.
    const double most = std::max(glm::compMax(material.diffuse), glm::compMax(material.specular));
    conserve_energy(properties, material, most, excess);
  }
  return material;
}

/// One reflectance function, whatever its parameters say: without a lobe the exponent means nothing.
Material simplest(Material material) {
  if (material.specular == Rgb(0.0) && material.kind == Material::Kind::phong) material.exponent_u = 0.0;
  return material;
}

Material read_two_sided(Properties& properties, const Document& document, ExcessEnergy excess) {
  const Element* nested = properties.object("bsdf");
  if (!nested || nested->type() == "twosided")
    fail(properties.element().where,
         "<bsdf type=\"twosided\"> around " + (nested ? nested->name() : "nothing"),
         "one nested or referenced diffuse, phong or anisotropicphong");
  Material material = read_material(*nested, document, excess);
  material.two_sided = true;
  return material;
}

} // namespace

scene::Material read_material(const Element& bsdf, const Document& document, ExcessEnergy excess) {
  Properties properties(bsdf, document);
  const std::string type = bsdf.type();
  if (type != "diffuse" && type != "phong" && type != "anisotropicphong" && type != "twosided")
    fail(bsdf.where, bsdf.name() + " is not supported", supported_bsdfs);
  if (properties.has("ensure_energy_conservation"))
    excess =
        properties.boolean("ensure_energy_conservation", false) ? ExcessEnergy::scale : ExcessEnergy::error;
  const Material material =
      type == "twosided" ? read_two_sided(properties, document, excess) : read_lobes(properties, excess);
  properties.finish();
  return simplest(material);
}

int share(std::vector<scene::Material>& materials, const scene::Material& material) {
  const auto found = std::ranges::find(materials, material);
  const auto index = found - materials.begin();
  if (found == materials.end()) materials.push_back(material);
  return static_cast<int>(index);
}

} // namespace phlux::scene_file
