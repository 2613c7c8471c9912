#include "scene_file/materials.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>

#include "scene_file/properties.h"

namespace phlux::scene_file {

namespace {

using scene::Material;
using scene::Parameter;
using scene::Rgb;

/// The sum of reflectances after Mitsuba's scaling.
constexpr double kept_energy = 0.99;

std::string supported_bsdfs(const lobes::Library& library) {
  std::string list;
  for (const auto& model : library.models()) list += model->name + ", ";
  return "supported are " + list + "and twosided around one of these";
}

std::string text(const Rgb& color) {
  return color.x == color.y && color.y == color.z ? fmt::format("{:g}", color.x)
                                                  : fmt::format("{:g} {:g} {:g}", color.x, color.y, color.z);
}

std::string range_of(const Parameter& parameter) {
  const std::string what = parameter.kind == Parameter::Kind::colour ? "every channel" : parameter.name;
  if (parameter.highest >= 1e30) return fmt::format("{} must be {:g} or more", what, parameter.lowest);
  return fmt::format("{} must be in [{:g}, {:g}]", what, parameter.lowest, parameter.highest);
}

/// Whether a reflectance above 1 is scaled down with the material's others.
bool may_be_scaled(const Parameter& parameter, ExcessEnergy excess) {
  return parameter.kind == Parameter::Kind::colour && parameter.highest == 1.0 &&
         excess == ExcessEnergy::scale;
}

void check_range(Properties& properties, const Parameter& parameter, const std::string& name,
                 const Rgb& smallest, const Rgb& largest, ExcessEnergy excess) {
  const bool too_low = glm::compMin(smallest) < parameter.lowest;
  const bool too_high = glm::compMax(largest) > parameter.highest && !may_be_scaled(parameter, excess);
  if (too_low || too_high)
    properties.fail_at(name, text(too_low ? smallest : largest) + " is out of range", range_of(parameter));
}

/// Appends the value of a parameter that the file calls `name`, and its texture.
void read_parameter(Properties& properties, const Parameter& parameter, const std::string& name,
                    MaterialRules rules, Material& material) {
  const bool colour = parameter.kind == Parameter::Kind::colour;
  if (const Element* element = colour ? properties.texture(name) : nullptr) {
    const scene::TexturePointer texture = rules.textures.read(*element, properties.document());
    material.values.emplace_back();
    material.set_texture(material.values.size() - 1, texture);
    check_range(properties, parameter, name, texture->smallest(), texture->largest(), rules.excess);
    return;
  }
  const Rgb value = colour ? properties.color(name, Rgb(parameter.default_value))
                           : Rgb(properties.real(name, parameter.default_value));
  check_range(properties, parameter, name, value, value, rules.excess);
  material.values.push_back(value);
}

/// Multiplies a colour of the material, constant or from a texture.
void scale(Material& material, std::size_t parameter, double factor) {
  const scene::TexturePointer texture = material.texture(parameter);
  if (!texture) {
    material.values[parameter] *= factor;
    return;
  }
  scene::Texture scaled = *texture;
  scaled.scale *= factor;
  material.set_texture(parameter, std::make_shared<const scene::Texture>(scaled));
}

/// If the largest reflectance exceeds 1, scales the colours by .99 / it, as Mitsuba does, or fails.
void conserve_energy(Properties& properties, Material& material, ExcessEnergy excess) {
  const double most = lobes::largest_reflectance(material);
  if (most <= 1.0) return;
  const Location& where = properties.element().where;
  const std::string wrong =
      properties.element().name() + " reflects " + std::to_string(most) + " times what arrives";
  std::string colours;
  for (const Parameter& parameter : material.model->parameters)
    if (parameter.kind == Parameter::Kind::colour)
      colours += (colours.empty() ? "" : " + ") + properties.spelling(parameter.name);
  if (excess == ExcessEnergy::error)
    fail(where, wrong,
         colours + " must be at most 1 in every channel (ensureEnergyConservation=true scales them down)");
  for (std::size_t i = 0; i < material.values.size(); ++i)
    if (material.model->parameters[i].kind == Parameter::Kind::colour) scale(material, i, kept_energy / most);
  warn(where, wrong + "; its reflectances are scaled by " + std::to_string(kept_energy / most));
}

/// Mitsuba's conductor has a metal's indices of refraction, by default copper's; ours is a mirror with a
/// reflectance.
void require_no_metal(Properties& properties) {
  const std::string otherwise = properties.document().major_version == 0 ? "Cu" : "none";
  const std::string metal = properties.string("material", otherwise);
  if (metal != "none")
    properties.fail_at("material", "a conductor of " + metal + " is not supported",
                       R"(<string name="material" value="none"/>, a mirror of specularReflectance)");
}

Material read_model(Properties& properties, const lobes::ModelPointer& model, MaterialRules rules) {
  Material material;
  material.model = model;
  if (model->name == "conductor") require_no_metal(properties);
  for (const Parameter& parameter : model->parameters) {
    // Mitsuba also accepts this name for the reflectance of a diffuse bsdf.
    const bool long_name =
        model->name == "diffuse" && properties.has("diffuse_reflectance") && !properties.has("reflectance");
    const std::string name = long_name ? "diffuse_reflectance" : parameter.name;
    read_parameter(properties, parameter, name, rules, material);
  }
  if (material.is_textured()) material.textures.resize(material.values.size());
  conserve_energy(properties, material, rules.excess);
  return material;
}

Material read_two_sided(Properties& properties, const Document& document, MaterialRules rules) {
  const Element* nested = properties.object("bsdf");
  if (!nested || nested->type() == "twosided")
    fail(properties.element().where,
         "<bsdf type=\"twosided\"> around " + (nested ? nested->name() : "nothing"),
         "one nested or referenced bsdf; " + supported_bsdfs(rules.library));
  Material material = read_material(*nested, document, rules);
  material.two_sided = true;
  return material;
}

} // namespace

scene::Material read_material(const Element& bsdf, const Document& document, MaterialRules rules) {
  Properties properties(bsdf, document);
  const std::string type = bsdf.type();
  const lobes::ModelPointer model = rules.library.find(type);
  if (!model && type != "twosided")
    fail(bsdf.where, bsdf.name() + " is not supported",
         supported_bsdfs(rules.library) + "; `lobe` NAME.cl adds a model of your own");
  if (properties.has("ensure_energy_conservation"))
    rules.excess =
        properties.boolean("ensure_energy_conservation", false) ? ExcessEnergy::scale : ExcessEnergy::error;
  const Material material =
      model ? read_model(properties, model, rules) : read_two_sided(properties, document, rules);
  properties.finish();
  return lobes::simplest(material);
}

int share(std::vector<scene::Material>& materials, const scene::Material& material) {
  const auto found = std::ranges::find(materials, material);
  const auto index = found - materials.begin();
  if (found == materials.end()) materials.push_back(material);
  return static_cast<int>(index);
}

} // namespace phlux::scene_file
