#include "render/parts.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "errors.h"
#include "phong/reflectivity.h"

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
    {&Parts::two_sided, "two_sided", "HAS_TWO_SIDED"},
    {&Parts::black, "black", "HAS_BLACK"},
    {&Parts::phong_lobe, "phong_lobe", "HAS_PHONG_LOBE"},
    {&Parts::anisotropic, "anisotropic", "HAS_ANISOTROPIC"},
    {&Parts::light_planar, "light_planar", "HAS_PLANAR_LIGHTS"},
    {&Parts::light_sphere, "light_sphere", "HAS_SPHERE_LIGHTS"},
    {&Parts::light_point, "light_point", "HAS_POINT_LIGHTS"},
    {&Parts::light_spot, "light_spot", "HAS_SPOT_LIGHTS"},
    {&Parts::light_directional, "light_directional", "HAS_DIRECTIONAL_LIGHTS"},
    {&Parts::light_constant, "light_constant", "HAS_CONSTANT_LIGHT"},
    {&Parts::light_choice, "light_choice", "HAS_LIGHT_CHOICE"},
    {&Parts::light_tree, "light_tree", "HAS_LIGHT_TREE"},
    {&Parts::ambient, "ambient", "HAS_AMBIENT"},
};

struct NamedStrategy {
  const char* name;
  const char* macro;
};
constexpr NamedStrategy strategies[] = {{"uniform", "STRATEGY_UNIFORM"},
                                        {"theta-phi", "STRATEGY_THETA_PHI"},
                                        {"cosine", "STRATEGY_COSINE"},
                                        {"disk", "STRATEGY_DISK"},
                                        {"rejection", "STRATEGY_REJECTION"},
                                        {"lobe-ks", "STRATEGY_LOBE_KS"},
                                        {"lobe-estimate-printed", "STRATEGY_LOBE_ESTIMATE_PRINTED"},
                                        {"lobe-estimate", "STRATEGY_LOBE_ESTIMATE"},
                                        {"lobe-rho", "STRATEGY_LOBE_RHO"},
                                        {"mixture", "STRATEGY_MIXTURE"},
                                        {"fold", "STRATEGY_FOLD"},
                                        {"exact", "STRATEGY_EXACT"}};

const NamedStrategy& find_strategy(const std::string& name) {
  const auto found = std::find_if(std::begin(strategies), std::end(strategies),
                                  [&](const auto& s) { return s.name == name; });
  if (found != std::end(strategies)) return *found;
  std::string list;
  for (const auto& s : strategies) list += (list.empty() ? "" : ", ") + std::string(s.name);
  throw UsageError("--strategy " + name + ": there is no such strategy: " + list);
}

Integrator find_integrator(const std::string& name) {
  if (name == "path") return Integrator::path;
  if (name == "light") return Integrator::light;
  if (name == "bidir") return Integrator::bidir;
  throw UsageError("integrator " + name + ": there is no such integrator: path, light, bidir");
}

Connect possible_connect(const Settings& settings, const tables::LightTable& lights) {
  const bool hittable = lights.has(LIGHT_PLANAR) || lights.has(LIGHT_SPHERE) || lights.has(LIGHT_CONSTANT);
  if (settings.integrator == "path" && settings.connect == Connect::none && !lights.records.empty() &&
      !hittable)
    throw UsageError(
        "--connect none: no path can hit the point, spot and directional lights, which are all that the "
        "scene has: use --connect light or mis");
  if (settings.integrator == "light" || !lights.shines()) return Connect::none;
  return settings.integrator == "bidir" ? Connect::mis : settings.connect;
}

// Hit or miss draws this often for one sample of the material where it reflects least.
double proposals(const scene::Material& m) {
  const double diffuse = std::max({m.diffuse.r, m.diffuse.g, m.diffuse.b});
  const double specular = std::max({m.specular.r, m.specular.g, m.specular.b});
  const double highest = diffuse + specular * (m.exponent_u / 2 + 1);
  return highest / (diffuse + specular * phong::lobe_reflectivity(m.exponent_u, 0.0));
}

void refuse_endless_rejection(const scene::Material& m) {
  constexpr double most_proposals = 1e4;
  if (proposals(m) > most_proposals)
    throw UsageError(
        fmt::format("--strategy rejection: a phong of exponent {:g} takes {:.0g} draws a sample: use "
                    "another strategy",
                    m.exponent_u, proposals(m)));
}

// Materials that some primitive has; a scene may define others.
std::vector<const scene::Material*> used_materials(const scene::Scene& scene,
                                                   const accel::Geometry& geometry) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const PrimitiveRecord& p : geometry.primitives)
    if (p.region != REGION_NONE) used[static_cast<std::size_t>(p.material)] = true;
  std::vector<const scene::Material*> materials;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) materials.push_back(&scene.materials[i]);
  return materials;
}

} // namespace

const std::vector<std::string>& strategy_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& s : strategies) list.emplace_back(s.name);
    return list;
  }();
  return names;
}

int lanes_for(const device::DeviceInfo& device, const Settings& settings) {
  if (!settings.double_precision) return settings.lanes != 0 ? settings.lanes : device.lanes;
  if (settings.lanes > 1)
    throw UsageError(fmt::format(
        "--precision double: doubles go one path at a time, not {}: leave --width out", settings.lanes));
  if (!device.doubles)
    throw DeviceError(fmt::format(
        "{}: --precision double: the device has no doubles (cl_khr_fp64): use --precision single, or "
        "--device with one for which `phlux devices --json` says doubles",
        device.name));
  return 1;
}

// Of fewer, the walk down a tree and up again costs more than it brings (bench/saved/REMEDIES.md).
constexpr std::size_t fewest_lights_of_tree = 8;

bool samples_lights(const Settings& settings) {
  return settings.integrator == "bidir" ||
         (settings.integrator == "path" && settings.connect != Connect::none);
}

bool wants_light_tree(const Settings& settings) {
  return samples_lights(settings) && settings.light_selection == LightSelection::contribution;
}

Parts find_parts(const scene::Scene& scene, const accel::Geometry& geometry, const tables::LightTable& lights,
                 const Settings& settings, int lanes) {
  Parts parts;
  parts.lanes = lanes;
  parts.double_precision = settings.double_precision;
  parts.integrator = find_integrator(settings.integrator);
  parts.weights = settings.weights;
  parts.techniques = settings.techniques;
  if (parts.techniques && parts.integrator == Integrator::path)
    throw UsageError("--contributions: a path from the eye is made in one way: use -i bidir or light");
  // What a technique brings by itself is shown whole.
  if (parts.integrator == Integrator::bidir && !parts.techniques) parts.connections = settings.connections;
  if (settings.clamp) parts.clamp = *settings.clamp / lights.unit;
  if (parts.clamp && parts.techniques)
    throw UsageError("--clamp: what techniques bring is not clamped: leave out --contributions");
  parts.ambient = settings.ambient.has_value();
  if (parts.ambient && parts.integrator != Integrator::path)
    throw UsageError("--ambient: only paths from the eye can carry the ambient term: use -i path");
  if (!lights.shines()) { // the image is black, which is best left to the one that chooses no light
    parts.integrator = Integrator::path;
    parts.techniques = false;
  }
  parts.strategy = find_strategy(settings.strategy).macro;
  parts.connect = possible_connect(settings, lights);
  parts.hierarchy = !geometry.nodes.empty() || geometry.root < 0;
  parts.triangles = geometry.has_triangles;
  parts.parallelograms = geometry.has_parallelograms;
  parts.ellipses = geometry.has_ellipses;
  parts.planars = parts.triangles || parts.parallelograms || parts.ellipses;
  parts.spheres = geometry.sphere_count > 0;
  parts.smooth_normals = !geometry.vertex_normals.empty();
  for (const scene::Material* m : used_materials(scene, geometry)) {
    const bool anisotropic = m->kind == scene::Material::Kind::anisotropic_phong;
    const bool lobe = !anisotropic && m->specular != scene::Rgb(0.0);
    parts.two_sided |= m->two_sided;
    parts.black |= !m->reflects();
    parts.anisotropic |= anisotropic;
    parts.phong_lobe |= lobe;
    if (lobe && settings.strategy == "rejection") refuse_endless_rejection(*m);
  }
  if (parts.ambient && parts.anisotropic)
    throw UsageError(
        "--ambient: the reflectivity of anisotropicphong has no closed form to weigh the ambient term "
        "with: leave it out or use phong");
  parts.emission = lights.has(LIGHT_PLANAR) || lights.has(LIGHT_SPHERE);
  parts.light_planar = lights.has(LIGHT_PLANAR);
  parts.light_sphere = lights.has(LIGHT_SPHERE);
  parts.light_point = lights.has(LIGHT_POINT);
  parts.light_spot = lights.has(LIGHT_SPOT);
  parts.light_directional = lights.has(LIGHT_DIRECTIONAL);
  parts.light_constant = lights.has(LIGHT_CONSTANT);
  const bool chooses = parts.connect != Connect::none || parts.integrator == Integrator::light;
  parts.light_choice = lights.records.size() > 1 && chooses;
  parts.light_tree = wants_light_tree(settings) && parts.connect != Connect::none &&
                     lights.nodes.size() >= 2 * fewest_lights_of_tree;
  parts.one_light = lights.records.size() == 1;
  parts.few_lights = lights.records.size() <= few_entries;
  parts.few_materials = scene.materials.size() <= few_entries;
  parts.few_primitives = geometry.primitives.size() <= few_entries && !parts.hierarchy;
  return parts;
}

std::vector<std::string> Parts::names() const {
  std::vector<std::string> list;
  for (const NamedPart& part : named_parts)
    if (this->*part.member) list.emplace_back(part.name);
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
  switch (integrator) {
  case Integrator::light:
    return "transport/light.cl";
  case Integrator::bidir:
    return "transport/bidir.cl";
  default:
    return "transport/path.cl";
  }
}

std::map<std::string, std::string> Parts::defines() const {
  std::map<std::string, std::string> macros;
  const auto define = [&](const char* name, bool value) { macros[name] = value ? "1" : "0"; };
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
  macros["WEIGHTS"] = weights == Weights::balance ? "WEIGHTS_BALANCE"
                      : weights == Weights::power ? "WEIGHTS_POWER"
                                                  : "WEIGHTS_UNIFORM";
  macros["PHONG_TABLE_INTERVALS"] = std::to_string(phong::reflectivity_intervals);
  if (double_precision) macros["PHLUX_DOUBLE"] = "1";
  macros["WIDTH"] = std::to_string(lanes);
  macros["STRATEGY"] = strategy;
  macros["CONNECT"] = connect == Connect::none    ? "CONNECT_NONE"
                      : connect == Connect::light ? "CONNECT_LIGHT"
                                                  : "CONNECT_MIS";
  return macros;
}

} // namespace phlux::render
