#include "render/parts.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtx/component_wise.hpp>

#include "errors.h"
#include "phong/reflectivity.h"
#include "tables/used_materials.h"

namespace phlux::render {
namespace {

struct NamedPart {
  bool Parts::*member;
  const char* name;
  const char* macro;
};

constexpr NamedPart named_parts[] = {
    {&Parts::hierarchy, "hierarchy", "HAS_BVH"},
    {&Parts::triangles, "triangles", "HAS_TRIANGLES"},
    {&Parts::parallelograms, "parallelograms", "HAS_PARALLELOGRAMS"},
    {&Parts::ellipses, "ellipses", "HAS_ELLIPSES"},
    {&Parts::spheres, "spheres", "HAS_SPHERES"},
    {&Parts::smooth_normals, "smooth_normals", "HAS_SMOOTH_NORMALS"},
    {&Parts::strict_normals, "strict_normals", "HAS_STRICT_NORMALS"},
    {&Parts::two_sided, "two_sided", "HAS_TWO_SIDED"},
    {&Parts::black, "black", "HAS_BLACK"},
    {&Parts::masks, "masks", "HAS_MASKS"},
    {&Parts::checkerboards, "checkerboards", "HAS_CHECKERBOARDS"},
    {&Parts::byte_textures, "byte_textures", "HAS_BYTE_TEXTURES"},
    {&Parts::float_textures, "float_textures", "HAS_FLOAT_TEXTURES"},
    {&Parts::light_planar, "light_planar", "HAS_PLANAR_LIGHTS"},
    {&Parts::light_sphere, "light_sphere", "HAS_SPHERE_LIGHTS"},
    {&Parts::light_point, "light_point", "HAS_POINT_LIGHTS"},
    {&Parts::light_spot, "light_spot", "HAS_SPOT_LIGHTS"},
    {&Parts::light_directional, "light_directional", "HAS_DIRECTIONAL_LIGHTS"},
    {&Parts::light_constant, "light_constant", "HAS_CONSTANT_LIGHT"},
    {&Parts::environment_map, "environment_map", "HAS_ENVIRONMENT_MAP"},
    {&Parts::lens, "lens", "HAS_LENS"},
    {&Parts::orthographic, "orthographic", "HAS_ORTHOGRAPHIC"},
    {&Parts::tent_filter, "tent_filter", "HAS_TENT_FILTER"},
    {&Parts::gaussian_filter, "gaussian_filter", "HAS_GAUSSIAN_FILTER"},
    {&Parts::hidden_emitters, "hidden_emitters", "HAS_HIDDEN_EMITTERS"},
    {&Parts::light_choice, "light_choice", "HAS_LIGHT_CHOICE"},
    {&Parts::light_tree, "light_tree", "HAS_LIGHT_TREE"},
    {&Parts::sky_samples, "sky_samples", "HAS_SKY_SAMPLES"},
    {&Parts::ambient, "ambient", "HAS_AMBIENT"},
};

Connect possible_connect(const Settings& settings, const tables::LightTable& lights) {
  const bool hittable = lights.has(LIGHT_PLANAR) || lights.has(LIGHT_SPHERE) || lights.has(LIGHT_SKY);
  if (settings.integrator == "path" && settings.connect == Connect::none && !lights.records.empty() &&
      !hittable)
    throw UsageError(
        "`connect` none: no path can hit the point, spot and directional lights, which are all that the "
        "scene has: use `connect` light or mis");
  return lights.shines() ? connect_of(settings) : Connect::none;
}

// Expected number of proposals of rejection sampling per sample, at grazing incidence, where it is largest.
double proposals(const scene::Material& m) {
  const double diffuse = m.is_textured() ? 0.0 : glm::compMax(m.value("diffuse_reflectance")); // some texel's
  const double specular = glm::compMax(m.value("specular_reflectance")), exponent = m.value("exponent").x;
  const double highest = diffuse + specular * (exponent / 2 + 1);
  return highest / (diffuse + specular * phong::lobe_reflectivity(exponent, 0.0));
}

void refuse_endless_rejection(const scene::Material& m) {
  constexpr double most_proposals = 1e4;
  if (proposals(m) > most_proposals)
    throw UsageError(
        fmt::format("`strategy` rejection: a phong of exponent {:g} needs {:.0g} draws per sample: use "
                    "another strategy",
                    m.value("exponent").x, proposals(m)));
}

// The constant of the kernels for a choice: ROULETTE and "kd-ks" give ROULETTE_KD_KS.
std::string choice_macro(const std::string& name, const std::string& chosen) {
  std::string macro = name + "_" + chosen;
  for (char& c : macro) c = c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return macro;
}

} // namespace

int lanes_for(const device::DeviceInfo& device, const Settings& settings) {
  if (!settings.double_precision) return settings.lanes != 0 ? settings.lanes : device.lanes;
  if (settings.lanes > 1)
    throw UsageError(fmt::format(
        "`precision` double: kernels trace one path at a time in double, not {}: leave `width` out",
        settings.lanes));
  if (!device.doubles)
    throw DeviceError(fmt::format(
        "{}: `precision` double: the device has no doubles (cl_khr_fp64): use `precision` single, or "
        "a device that has them",
        device.name));
  return 1;
}

double in_units(const char* setting, double radiance, double unit) {
  constexpr double least = 1e-30, most = 1e30; // a float, and products with ordinary numbers
  const double value = radiance / unit;
  if (value >= least && value <= most) return value;
  throw UsageError(fmt::format("{} {:g}: must be from {:g} to {:g}: with lights of about {:g} in the scene, "
                               "single precision cannot hold other values",
                               settings::quoted(setting), radiance, least * unit, most * unit, unit));
}

// With fewer, descending the tree takes more time than the lower variance gains (bench/saved/REMEDIES.md).
constexpr std::size_t fewest_lights_of_tree = 8;

namespace {

// What the settings choose, as far as the lights allow.
void add_method(Parts& parts, const Settings& settings, const tables::LightTable& lights) {
  parts.double_precision = settings.double_precision;
  parts.integrator = settings::integrator_named(settings.integrator).integrator;
  parts.weights = settings.weights;
  parts.techniques = settings.techniques;
  parts.roulette = settings.roulette;
  // Images of techniques need every connection.
  if (parts.integrator == Integrator::bidir && !parts.techniques) parts.connections = settings.connections;
  if (settings.clamp) parts.clamp = in_units("clamp", *settings.clamp, lights.unit);
  if (parts.clamp && parts.techniques)
    throw UsageError("`clamp`: contributions of techniques are not clamped: leave out `contributions`");
  if (samples_point_sets(settings)) parts.sampler = settings.sampler;
  parts.ambient = settings.ambient.has_value();
  if (parts.ambient) static_cast<void>(in_units("ambient", *settings.ambient, lights.unit));
  if (parts.ambient && parts.integrator != Integrator::path)
    throw UsageError("`ambient` is for path only: use `integrator` path");
  if (!lights.shines()) { // the image is black, and path tracing does not need a light
    parts.integrator = Integrator::path;
    parts.techniques = false;
  }
  parts.strategy = settings::strategy(settings::quoted("strategy"), settings.strategy);
  parts.connect = possible_connect(settings, lights);
}

void add_geometry(Parts& parts, const scene::Scene& scene, const accel::Geometry& geometry) {
  parts.hierarchy = !geometry.nodes.empty() || geometry.root < 0;
  parts.triangles = geometry.has_triangles;
  parts.parallelograms = geometry.has_parallelograms;
  parts.ellipses = geometry.has_ellipses;
  parts.spheres = geometry.sphere_count > 0;
  parts.smooth_normals = !geometry.vertex_normals.empty();
  parts.strict_normals = parts.smooth_normals && scene.strict_normals;
  parts.few_primitives = geometry.primitives.size() <= few_entries && !parts.hierarchy;
}

void add_textures(Parts& parts, const scene::Material& material) {
  std::vector<scene::TexturePointer> textures = material.textures;
  textures.push_back(material.opacity_texture);
  for (const scene::TexturePointer& texture : textures) {
    if (!texture) continue;
    parts.checkerboards |= !texture->image;
    parts.byte_textures |= texture->image && !texture->image->bytes.empty();
    parts.float_textures |= texture->image && texture->image->bytes.empty();
  }
}

// After add_method().
void add_materials(Parts& parts, const scene::Scene& scene, const std::vector<scene::Material>& used,
                   const Settings& settings) {
  parts.models = lobes::models_of(used);
  parts.masks = lobes::any_masked(scene.materials);
  parts.few_materials = scene.materials.size() <= few_entries;
  for (const scene::Material& m : used) {
    parts.two_sided |= m.two_sided || m.model->transmits;
    parts.black |= !lobes::reflects(m);
    add_textures(parts, m);
    if (settings.strategy == "rejection" && m.model == lobes::shipped("phong")) refuse_endless_rejection(m);
  }
  for (const auto& model : parts.models)
    if (parts.ambient && model->reflectivity_is_estimate)
      throw UsageError(fmt::format(
          "`ambient`: needs a reflectivity in closed form, which {} does not have: leave it out or use phong",
          model->name));
    else if (parts.ambient && model->transmits)
      throw UsageError(
          fmt::format("`ambient`: does not support {}, which transmits light: leave it out", model->name));
}

// After add_method().
void add_lights(Parts& parts, const scene::Scene& scene, const tables::LightTable& lights) {
  parts.light_planar = lights.has(LIGHT_PLANAR);
  parts.light_sphere = lights.has(LIGHT_SPHERE);
  parts.light_point = lights.has(LIGHT_POINT);
  parts.light_spot = lights.has(LIGHT_SPOT);
  parts.light_directional = lights.has(LIGHT_DIRECTIONAL);
  parts.environment_map = scene.environment.has_value();
  parts.hidden_emitters = scene.hide_emitters;
  parts.light_constant = lights.has(LIGHT_SKY) && !parts.environment_map;
  const bool chooses = parts.connect != Connect::none || parts.integrator == Integrator::light;
  parts.light_choice = lights.records.size() > 1 && chooses;
  parts.light_tree = parts.connect != Connect::none && lights.nodes.size() >= 2 * fewest_lights_of_tree;
  parts.sky_samples = parts.connect != Connect::none && lights.samples_sky();
  parts.one_light = lights.records.size() == 1;
  parts.few_lights = lights.records.size() <= few_entries;
}

void add_camera(Parts& parts, const scene::Camera& camera) {
  parts.lens = camera.aperture_radius > 0;
  parts.orthographic = camera.orthographic;
  parts.tent_filter = camera.filter.kind == scene::Filter::Kind::tent;
  parts.gaussian_filter = camera.filter.kind == scene::Filter::Kind::gaussian;
}

} // namespace

Parts find_parts(const scene::Scene& scene, const accel::Geometry& geometry, const tables::LightTable& lights,
                 const Settings& settings, int lanes) {
  Parts parts;
  parts.lanes = lanes;
  add_method(parts, settings, lights);
  add_geometry(parts, scene, geometry);
  add_materials(parts, scene, tables::used_materials(scene, geometry), settings);
  add_lights(parts, scene, lights);
  add_camera(parts, scene.camera);
  return parts;
}

bool Parts::has_model(const std::string& name) const {
  return std::ranges::any_of(models, [&](const auto& model) { return model->name == name; });
}

bool Parts::has_tangents() const {
  return std::ranges::any_of(models, [](const auto& model) { return model->needs_tangents; });
}

std::vector<std::string> Parts::names() const {
  std::vector<std::string> list;
  for (const NamedPart& part : named_parts)
    if (this->*part.member) list.emplace_back(part.name);
  if (double_precision) list.emplace_back("double_precision");
  for (const auto& model : models) list.push_back(model->name);
  return list;
}

std::vector<std::string> Parts::all_names() {
  std::vector<std::string> list;
  for (const NamedPart& part : named_parts) list.emplace_back(part.name);
  return list;
}

void Parts::set(const std::string& name, bool on) {
  const auto found = std::ranges::find(named_parts, name, &NamedPart::name);
  if (found == std::end(named_parts)) throw std::out_of_range("there is no part " + name);
  this->*found->member = on;
}

const char* Parts::file() const {
  return settings::info_of(integrator).kernel_file;
}

std::map<std::string, std::string> Parts::defines() const {
  std::map<std::string, std::string> macros;
  const auto define = [&](const char* name, bool value) { macros[name] = value ? "1" : "0"; };
  const auto choose = [&](const char* name, const std::vector<std::string>& names, auto value) {
    macros[name] = choice_macro(name, names[static_cast<std::size_t>(value)]);
  };
  for (const NamedPart& part : named_parts) define(part.macro, this->*part.member);
  define("ONE_LIGHT", one_light);
  define("FEW_LIGHTS", few_lights);
  define("FEW_MATERIALS", few_materials);
  define("FEW_PRIMITIVES", few_primitives);
  define("RECORD_TECHNIQUES", techniques);
  define("HAS_CLAMP", clamp && integrator != Integrator::light);
  define("IS_BIDIR", integrator == Integrator::bidir);
  macros["CLAMP_RADIANCE"] = fmt::format("{:a}f", clamp.value_or(0));
  macros["CONNECTIONS"] = std::to_string(integrator == Integrator::bidir ? connections : 0);
  choose("WEIGHTS", settings::weights_names(), weights);
  choose("SAMPLER", settings::sampler_names(), sampler);
  choose("ROULETTE", settings::roulette_names(), roulette);
  choose("CONNECT", settings::connect_names(), connect);
  macros["PHONG_TABLE_INTERVALS"] = std::to_string(phong::reflectivity_intervals);
  if (double_precision) macros["PHLUX_DOUBLE"] = "1";
  macros["WIDTH"] = std::to_string(lanes);
  macros["PHONG_STRATEGY"] = settings::is_strategy_file(strategy)
                                 ? fmt::format("\"{}\"", strategy)
                                 : fmt::format("\"phong/strategies/{}.cl\"", strategy);
  macros.merge(lobes::defines_of(models, masks));
  return macros;
}

device::ProgramSource Parts::source(const std::string& root, const std::string& extra) const {
  std::map<std::string, std::string> files = lobes::files_of(models);
  if (settings::is_strategy_file(strategy)) files[strategy] = settings::read_strategy(strategy);
  return {root, defines(), std::move(files), extra};
}

} // namespace phlux::render
