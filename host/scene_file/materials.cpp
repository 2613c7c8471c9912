#include "scene_file/materials.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>

#include "lobes/assignment.h"
#include "lobes/facets.h"
#include "scene/hash.h"
#include "scene_file/named_media.h"
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
  return "supported are " + list + "null, and twosided or mask around one of these";
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

constexpr auto beckmann_facets = static_cast<double>(lobes::FacetDistribution::beckmann),
               ggx_facets = static_cast<double>(lobes::FacetDistribution::ggx),
               phong_facets = static_cast<double>(lobes::FacetDistribution::phong);

/// The number by which kernels name a distribution of facets (kernels/lobes/microfacets.h).
double read_distribution(Properties& properties) {
  const std::string name = properties.string("distribution", "beckmann");
  if (name == "beckmann") return beckmann_facets;
  if (name == "ggx") return ggx_facets;
  if (name == "phong" || name == "as") return phong_facets;
  properties.fail_at("distribution", "no distribution is named '" + name + "'", "beckmann, ggx, phong or as");
}

/// alpha_u or alpha_v, each `alpha` unless it is given; `alpha` itself where both are equal. How facets are
/// sampled changes no mean.
double read_roughness(Properties& properties, const std::string& name) {
  properties.pass_over({"sample_visible"});
  return properties.real(name == "alpha" ? "alpha_u" : name, properties.real("alpha", 0.1));
}

/// The model of a rough surface by the roughnesses that are given.
lobes::ModelPointer rough_model(Properties& properties, const lobes::ModelPointer& model) {
  if (!model || !model->text.empty() || !lobes::find_parameter(*model, "alpha")) return model;
  if (read_roughness(properties, "alpha_u") == read_roughness(properties, "alpha_v")) return model;
  const bool plastic = model->name == "roughplastic";
  if (plastic || read_distribution(properties) == phong_facets)
    properties.fail_at("alpha_v",
                       "a " + (plastic ? model->name : "Phong distribution") + " of two roughnesses",
                       plastic ? "one alpha" : "one alpha, or beckmann or ggx");
  return lobes::shipped(model->name == "roughconductor" ? "anisotropicconductor" : "anisotropicdielectric");
}

/// A number of a model that ships may have another form in the file.
double read_number(Properties& properties, const Parameter& parameter, const std::string& name, bool ships) {
  if (ships && name.ends_with("_ior")) return properties.index_of_refraction(name, parameter.default_value);
  if (ships && name == "distribution") return read_distribution(properties);
  if (ships && name == "nonlinear") return properties.boolean(name, false) ? 1 : 0;
  if (ships && name == "lossy")
    return properties.boolean(name, properties.document().major_version > 0) ? 1 : 0;
  if (ships && name.starts_with("alpha")) return read_roughness(properties, name);
  return properties.real(name, parameter.default_value);
}

void check_range(Properties& properties, const Parameter& parameter, const std::string& name,
                 const Rgb& smallest, const Rgb& largest, ExcessEnergy excess) {
  const bool too_low = glm::compMin(smallest) < parameter.lowest;
  const bool too_high = glm::compMax(largest) > parameter.highest && !may_be_scaled(parameter, excess);
  if (too_low || too_high)
    properties.fail_at(name, text(too_low ? smallest : largest) + " is out of range", range_of(parameter));
}

/// eta or k of a metal. Fresnel's reflectance depends on their squares, so that Mitsuba renders fits to
/// measurements that are negative in a channel.
Rgb read_index(Properties& properties, const std::string& name, const Rgb& index) {
  if (glm::compMin(index) >= 0.0) return index;
  properties.document().warnings->add(properties.where(name),
                                      "a negative " + name + " counts as positive, as in Mitsuba");
  return glm::abs(index);
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
  const bool ships = material.model->text.empty();
  Rgb value = colour ? properties.color(name, Rgb(parameter.default_value), parameter.highest)
                     : Rgb(read_number(properties, parameter, name, ships));
  if (colour && ships && (name == "eta" || name == "k")) value = read_index(properties, name, value);
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
         colours + " must be at most 1 in every channel, or <boolean name=\"" +
             properties.spelling("ensure_energy_conservation") +
             "\" value=\"true\"/> in the bsdf or the scene scales them down, as Mitsuba 0.6 does by default");
  for (std::size_t i = 0; i < material.values.size(); ++i)
    if (may_be_scaled(material.model->parameters[i], excess)) scale(material, i, kept_energy / most);
  properties.document().warnings->add(
      where, wrong + "; its reflectances are scaled by " + std::to_string(kept_energy / most),
      "too much energy");
}

/// The index of refraction that a conductor has unless `eta` and `k` are given: that of `material`, "none"
/// for a mirror; relative to that of `ext_eta`. In version 0 of the format, these are copper and air by
/// default, and eta or k alone replaces that of the material.
void read_conductor(Properties& properties, Material& material) {
  const bool version_0 = properties.document().major_version == 0;
  const bool has_eta = properties.has("eta"), has_k = properties.has("k");
  const std::string metal = properties.string("material", version_0 && !(has_eta && has_k) ? "Cu" : "none");
  const auto index = index_of_metal(metal);
  if (!index && metal != "none")
    properties.fail_at("material", "no metal is named '" + metal + "'",
                       "none (a mirror), or give eta and k as rgb, or one of " + names_of_metals());
  if (metal != "none" && (has_eta || has_k) && !version_0)
    properties.fail_at("material", "a metal and eta or k", "one of the two");
  Rgb &eta = material.value("eta"), &k = material.value("k");
  if (index && !has_eta) eta = index->eta;
  if (index && !has_k) k = index->k;
  const double outside = properties.index_of_refraction("ext_eta", version_0 ? 1.000277 : 1.0);
  if (!(outside > 0))
    properties.fail_at("ext_eta", fmt::format("{:g} is out of range", outside), "a number above 0");
  eta /= outside;
  k /= outside;
}

Material read_model(Properties& properties, const lobes::ModelPointer& model, MaterialRules rules) {
  Material material;
  material.model = model;
  for (const Parameter& parameter : model->parameters) {
    // Mitsuba also accepts this name for the reflectance of a diffuse bsdf.
    const bool long_name =
        model->name == "diffuse" && properties.has("diffuse_reflectance") && !properties.has("reflectance");
    const std::string name = long_name ? "diffuse_reflectance" : parameter.name;
    read_parameter(properties, parameter, name, rules, material);
  }
  if (material.is_textured()) material.textures.resize(material.values.size());
  if (properties.document().major_version == 0 && model->text.empty() && model->has_delta)
    properties.pass_over({"alpha", "distribution"}); // left from a rough bsdf; Mitsuba 0.x takes no notice
  if (model->text.empty() && lobes::find_parameter(*model, "eta") && lobes::find_parameter(*model, "k"))
    read_conductor(properties, material);
  conserve_energy(properties, material, rules.excess);
  return material;
}

Material read_two_sided(Properties& properties, const Document& document, MaterialRules rules) {
  if (properties.objects("bsdf").size() > 1)
    fail(properties.element().where,
         "<bsdf type=\"twosided\"> around two bsdfs: sides that differ are not supported",
         "one bsdf for both");
  const Element* nested = properties.object("bsdf");
  if (!nested || nested->type() == "twosided")
    fail(properties.element().where,
         "<bsdf type=\"twosided\"> around " + (nested ? nested->name() : "nothing"),
         "one nested or referenced bsdf; " + supported_bsdfs(rules.library));
  Material material = read_material(*nested, document, rules);
  if (material.model->transmits)
    fail(properties.element().where, "<bsdf type=\"twosided\"> around " + nested->name(),
         "leave twosided out: light passes through " + material.model->name +
             ", which has two sides already");
  material.two_sided = true;
  return material;
}

/// Opacities of masks inside one another multiply. From version 2 of the format on, the opacity is a number:
/// the mean of a colour, the luminance of a bitmap.
Material read_mask(Properties& properties, const Document& document, MaterialRules rules) {
  const Location& where = properties.element().where;
  const Element* nested = properties.object("bsdf");
  if (!nested)
    fail(where, "<bsdf type=\"mask\"> around nothing",
         "one nested or referenced bsdf; " + supported_bsdfs(rules.library));
  Material material = read_material(*nested, document, rules);
  const Parameter opacity{"opacity", Parameter::Kind::colour, 0.5, 0, 1, ""};
  const Element* element = properties.texture("opacity");
  if (material.is_masked() && (element || material.opacity_texture))
    fail(where, "a mask around a mask, and a texture in one of them", "one mask with the product of both");
  if (element) {
    material.set_opacity(rules.textures.read(*element, document, document.major_version > 0));
    check_range(properties, opacity, "opacity", material.opacity_texture->smallest(), material.opacity,
                ExcessEnergy::error);
    return material;
  }
  Rgb value = properties.color("opacity", Rgb(opacity.default_value));
  if (document.major_version > 0) value = Rgb((value.r + value.g + value.b) / 3.0);
  check_range(properties, opacity, "opacity", value, value, ExcessEnergy::error);
  material.opacity *= value;
  return material;
}

/// A surface that is not there.
Material null_material() {
  Material material = lobes::diffuse(Rgb(0.0));
  material.opacity = Rgb(0.0);
  return material;
}

} // namespace

scene::Material read_material(const Element& bsdf, const Document& document, MaterialRules rules) {
  Properties properties(bsdf, document);
  const std::string type = bsdf.type();
  const lobes::ModelPointer model = rough_model(properties, rules.library.find(type));
  if (!model && type != "twosided" && type != "mask" && type != "null")
    fail(bsdf.where, bsdf.name() + " is not supported",
         supported_bsdfs(rules.library) + "; `lobe` NAME.cl adds a model of your own");
  if (properties.has("ensure_energy_conservation"))
    rules.excess =
        properties.boolean("ensure_energy_conservation", false) ? ExcessEnergy::scale : ExcessEnergy::error;
  const Material material = model            ? read_model(properties, model, rules)
                            : type == "mask" ? read_mask(properties, document, rules)
                            : type == "null" ? null_material()
                                             : read_two_sided(properties, document, rules);
  properties.finish();
  return lobes::simplest(material);
}

SharedMaterials::SharedMaterials(std::vector<scene::Material>& materials) : materials_(materials) {
  for (std::size_t i = 0; i < materials.size(); ++i)
    indices_.emplace(scene::hash_of(materials[i]), static_cast<int>(i));
}

int SharedMaterials::index_of(const scene::Material& material) {
  const std::size_t hash = scene::hash_of(material);
  const auto [first, last] = indices_.equal_range(hash);
  for (auto each = first; each != last; ++each)
    if (materials_[static_cast<std::size_t>(each->second)] == material) return each->second;
  const int index = static_cast<int>(materials_.size());
  materials_.push_back(material);
  indices_.emplace(hash, index);
  return index;
}

} // namespace phlux::scene_file
