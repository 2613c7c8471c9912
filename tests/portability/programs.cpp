#include "portability/programs.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lobes/models.h"

namespace phlux::test {
namespace {

using render::Connect;
using render::Integrator;
using render::Parts;
using render::Roulette;
using render::Weights;

const std::vector<lobes::ModelPointer>& models() {
  static const lobes::Library shipped;
  return shipped.models();
}

// Reflectance models count as parts.
void set(Parts& parts, const std::string& name, bool on) {
  const auto model = std::ranges::find(models(), name, [](const auto& m) { return m->name; });
  if (model == models().end()) return parts.set(name, on);
  std::erase(parts.models, *model);
  if (on) parts.models.push_back(*model);
}

Parts parts_of(const std::string& names, const std::string& strategy) {
  Parts parts;
  parts.models.clear();
  parts.strategy = strategy;
  std::istringstream list(names);
  for (std::string name; list >> name;) set(parts, name, true);
  return parts;
}

// A part that requires another.
constexpr std::pair<const char*, const char*> needs[] = {
    {"triangles", "planars"},        {"parallelograms", "planars"}, {"ellipses", "planars"},
    {"light_planar", "planars"},     {"light_planar", "emission"},  {"light_sphere", "spheres"},
    {"light_sphere", "emission"},    {"smooth_normals", "planars"}, {"strict_normals", "smooth_normals"},
    {"smooth_normals", "triangles"}, {"light_tree", "light_choice"}};

Parts without(Parts parts, const std::string& name) {
  set(parts, name, false);
  for (const auto& [part, needed] : needs)
    if (name == needed) parts = without(parts, part);
  return parts;
}

// Without masks, textures and the models of smooth and rough glass, metal and plastic, which have programs of
// their own: no scene has them all.
Parts ordinary(Parts parts) {
  for (const char* name : {"masks", "checkerboards", "byte_textures", "float_textures", "conductor",
                           "dielectric", "thindielectric", "roughconductor", "roughdielectric", "plastic",
                           "roughplastic", "anisotropicconductor", "anisotropicdielectric"})
    parts = without(parts, name);
  return parts;
}

// With a phong in the scene, a diffuse material is a phong without a lobe. No scene has both an ambient term
// and an anisotropic lobe, whose reflectivity has no closed form.
Parts everything(Integrator integrator = Integrator::path) {
  Parts parts = parts_of(fmt::format("{}", fmt::join(all_parts(), " ")), "exact");
  parts.integrator = integrator;
  parts.connect = integrator == Integrator::light ? Connect::none : Connect::mis;
  return without(without(parts, "diffuse"), "ambient");
}

Parts by(Integrator integrator, Parts parts, Weights weights = Weights::balance) {
  parts.integrator = integrator;
  parts.weights = weights;
  parts.connect = integrator == Integrator::light ? Connect::none : Connect::mis;
  return parts;
}

Parts connecting(Parts parts, Connect connect) {
  parts.connect = connect;
  return parts;
}

Parts in_double(Parts parts) {
  parts.double_precision = true;
  return parts;
}

Parts with_techniques(Parts parts) {
  parts.techniques = true;
  return parts;
}

Parts with_clamp(Parts parts) {
  parts.clamp = 10;
  return parts;
}

Parts with_sampler(Parts parts, render::Sampler sampler) {
  parts.sampler = sampler;
  return parts;
}

Parts with_roulette_of_connections(Parts parts) {
  parts.connections = 2;
  return parts;
}

Parts with_roulette(Parts parts, Roulette roulette) {
  parts.roulette = roulette;
  return parts;
}

Parts few_of_all(Parts parts) {
  parts.one_light = parts.few_lights = parts.few_materials = parts.few_primitives = true;
  return parts;
}

constexpr char diffuse[] = "parallelograms light_planar diffuse";
constexpr char glossy[] = "parallelograms spheres phong light_planar";
constexpr char ambient[] = "parallelograms spheres phong black light_sphere ambient";
constexpr char mirrors[] = "parallelograms spheres phong mirror light_planar";
constexpr char glass[] = "parallelograms spheres two_sided phong dielectric light_planar light_constant";
constexpr char smooth[] = "parallelograms two_sided conductor thindielectric plastic light_planar";
constexpr char rough[] = "parallelograms two_sided roughdielectric roughconductor roughplastic light_planar";
constexpr char brushed[] = "parallelograms two_sided anisotropicdielectric anisotropicconductor light_planar "
                           "light_constant light_choice hidden_emitters";
constexpr char masked[] = "parallelograms spheres two_sided phong masks checkerboards light_planar";
constexpr char masked_mesh[] = "hierarchy triangles diffuse masks byte_textures light_planar";
constexpr char triangles[] = "hierarchy triangles smooth_normals phong light_planar light_choice light_tree";
constexpr char textured[] = "parallelograms spheres phong light_planar byte_textures";
constexpr char textured_mesh[] = "hierarchy triangles ellipses smooth_normals anisotropicphong light_planar "
                                 "checkerboards float_textures";
constexpr char sky[] = "spheres phong light_constant sky_samples";
constexpr char map[] =
    "parallelograms spheres diffuse light_planar light_choice environment_map sky_samples lens tent_filter";
constexpr char parallel[] = "parallelograms diffuse light_constant sky_samples orthographic gaussian_filter";

// A program for one reflectance model.
Program of_model(const std::string& file, const std::string& model, const std::string& strategy, int width) {
  Parts parts = parts_of(model, strategy);
  parts.lanes = width;
  Program program{fmt::format("{}-{}-{}.{}", file, model, strategy, width),
                  parts.source(fmt::format("measure/{}.cl", file))};
  program.source.defines["FIXED_DIRECTIONS"] = "16";         // of sampling.cl and figures.cl
  program.source.defines["SAMPLED_BY"] = "SAMPLED_BY_MODEL"; // of sampling.cl
  return program;
}

} // namespace

const std::vector<SceneProgram>& scene_programs() {
  static const std::vector<SceneProgram> list = {
      {"everything", ordinary(everything())},
      {"everything-brute-force", without(ordinary(everything()), "hierarchy")},
      {"diffuse-box", parts_of(diffuse, "cosine")},
      {"few-in-diffuse-box", few_of_all(parts_of(diffuse, "cosine"))},
      {"glossy-spheres", parts_of(glossy, "exact")},
      {"glossy-spheres-sobol", with_sampler(parts_of(glossy, "exact"), render::Sampler::sobol)},
      {"ambient", with_clamp(parts_of(ambient, "lobe-rho"))},
      {"mesh", connecting(parts_of(triangles, "lobe-ks"), Connect::light)},
      {"textured", parts_of(textured, "exact")},
      {"textured-mesh-bidir", by(Integrator::bidir, parts_of(textured_mesh, "exact"))},
      {"sphere-in-sky", connecting(parts_of(sky, "mixture"), Connect::none)},
      {"everything-light", by(Integrator::light, ordinary(everything()))},
      {"diffuse-box-light", by(Integrator::light, parts_of(diffuse, "cosine"))},
      {"glossy-spheres-light", by(Integrator::light, parts_of(glossy, "exact"))},
      {"glossy-spheres-light-roulette",
       with_roulette(by(Integrator::light, parts_of(glossy, "exact")), Roulette::throughput)},
      {"sky-light", with_techniques(by(Integrator::light, parts_of(sky, "mixture")))},
      {"everything-bidir", by(Integrator::bidir, ordinary(everything()))},
      {"diffuse-box-bidir", by(Integrator::bidir, parts_of(diffuse, "cosine"))},
      {"glossy-spheres-bidir",
       with_roulette_of_connections(by(Integrator::bidir, parts_of(glossy, "exact"), Weights::power))},
      {"glossy-spheres-bidir-clamp", with_clamp(by(Integrator::bidir, parts_of(glossy, "exact")))},
      {"mesh-bidir",
       with_techniques(by(Integrator::bidir, parts_of(triangles, "lobe-ks"), Weights::uniform))},
      {"map", parts_of(map, "exact")},
      {"map-light", by(Integrator::light, parts_of(map, "exact"))},
      {"map-bidir", by(Integrator::bidir, parts_of(map, "exact"))},
      {"parallel", parts_of(parallel, "exact")},
      {"parallel-light", by(Integrator::light, parts_of(parallel, "exact"))},
      {"parallel-bidir", by(Integrator::bidir, parts_of(parallel, "exact"))},
      {"glossy-spheres-bidir-roulette",
       with_roulette(by(Integrator::bidir, parts_of(glossy, "exact")), Roulette::efficiency)},
      {"diffuse-box-roulette", with_roulette(parts_of(diffuse, "cosine"), Roulette::reflectivity)},
      {"glossy-spheres-roulette", with_roulette(parts_of(glossy, "lobe-rho"), Roulette::kd_ks)},
      {"mirrors-bidir", by(Integrator::bidir, parts_of(mirrors, "exact"))},
      {"glossy-spheres-bidir-lattice",
       with_sampler(by(Integrator::bidir, parts_of(glossy, "exact")), render::Sampler::lattice)},
      {"glass-bidir", by(Integrator::bidir, parts_of(glass, "exact"))},
      {"smooth-light", by(Integrator::light, parts_of(smooth, "exact"))},
      {"rough-path", parts_of(rough, "exact")},
      {"rough-brushed", parts_of(brushed, "exact")},
      {"masked", parts_of(masked, "exact")},
      {"masked-light", by(Integrator::light, parts_of(masked, "exact"))},
      {"masked-mesh-bidir", by(Integrator::bidir, parts_of(masked_mesh, "exact"))},
      // With every part, double precision needs more registers than a thread can have.
      {"brushed-double", in_double(parts_of("parallelograms anisotropicphong light_planar", "exact"))},
      {"mirrors-double", in_double(parts_of(mirrors, "exact"))},
      {"mesh-double", in_double(parts_of(triangles, "exact"))},
      {"glossy-spheres-bidir-double", in_double(by(Integrator::bidir, parts_of(glossy, "exact")))}};
  return list;
}

std::vector<std::string> all_parts() {
  std::vector<std::string> names = Parts::all_names();
  for (const auto& model : models()) names.push_back(model->name);
  return names;
}

Program program_of(const SceneProgram& scene, int width) {
  Parts parts = scene.parts;
  parts.lanes = width;
  return {fmt::format("{}.{}", scene.name, width), parts.source(parts.file())};
}

std::vector<Program> programs() {
  std::vector<Program> list;
  for (const int width : {1, 4, 8, 16}) {
    for (const SceneProgram& scene : scene_programs())
      if (width == 1 || !scene.parts.double_precision) list.push_back(program_of(scene, width));
    for (const std::string& strategy : render::strategy_names())
      list.push_back(of_model("sampling", "phong", strategy, width));
    for (const auto& model : models()) list.push_back(of_model("verify", model->name, "exact", width));
    list.push_back(of_model("figures", "phong", "exact", width));
    list.push_back(of_model("figures", "phong", "exact", width));
    list.back().name = fmt::format("phong-example.{}", width);
    list.back().source.root = "phong/example.cl";
    list.back().source.extra = "#include \"phong/reflectivity.h\"\n"; // which a user's model may include
    list.push_back(of_model("arithmetic", "phong", "exact", width));
    list.push_back(of_model("arithmetic", "phong", "exact", width));
    list.back().name = fmt::format("arithmetic-native.{}", width);
    list.back().source.defines["PHLUX_NATIVE"] = "1";
    list.push_back(program_of({"first-hits", ordinary(everything())}, width));
    list.back().source.root = "transport/first_hit.cl";
    list.push_back(program_of({"rays", ordinary(everything())}, width));
    list.back().source.root = "measure/rays.cl";
  }
  return list;
}

std::vector<Ablation> ablations() {
  std::vector<Ablation> list;
  const auto add = [&](const std::string& base, Parts all) {
    all.connections = 2; // a part of only some bidir programs
    list.push_back({base, "", all});
    for (const std::string& name : all.names()) list.push_back({base, name, without(all, name)});
  };
  Parts path = everything();
  path.ambient = true;
  add("path-exact", path);
  path.strategy = "mixture";
  path.roulette =
      Roulette::reflectivity; // which needs functions that are otherwise of the ambient term alone
  add("path-mixture", path);
  add("light-exact", everything(Integrator::light));
  add("bidir-exact", everything(Integrator::bidir));
  return list;
}

} // namespace phlux::test
