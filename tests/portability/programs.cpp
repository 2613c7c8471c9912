#include "portability/programs.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace phlux::test {
namespace {

using render::Connect;
using render::Integrator;
using render::Parts;
using render::Weights;

std::string macro_of(const std::string& strategy) {
  std::string macro = "STRATEGY_" + strategy;
  for (char& c : macro) c = c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return macro;
}

Parts parts_of(const std::string& names, const std::string& strategy) {
  Parts parts;
  parts.strategy = macro_of(strategy);
  std::istringstream list(names);
  for (std::string name; list >> name;) parts.set(name, true);
  return parts;
}

// A part that cannot be without another.
constexpr std::pair<const char*, const char*> needs[] = {
    {"triangles", "planars"},      {"parallelograms", "planars"}, {"ellipses", "planars"},
    {"light_planar", "planars"},   {"light_planar", "emission"},  {"light_sphere", "spheres"},
    {"light_sphere", "emission"},  {"smooth_normals", "planars"}, {"smooth_normals", "triangles"},
    {"light_tree", "light_choice"}};

Parts without(Parts parts, const std::string& name) {
  parts.set(name, false);
  for (const auto& [part, needed] : needs)
    if (name == needed) parts = without(parts, part);
  return parts;
}

// No scene has both an ambient term and an anisotropic lobe, whose
// reflectivity has no closed form.
Parts everything(Integrator integrator = Integrator::path) {
  Parts parts;
  for (const std::string& name : Parts::all_names()) parts.set(name, true);
  parts.integrator = integrator;
  parts.connect = integrator == Integrator::light ? Connect::none : Connect::mis;
  parts.strategy = macro_of("exact");
  return without(parts, "ambient");
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

Parts with_roulette_of_connections(Parts parts) {
  parts.connections = 2;
  return parts;
}

Parts few_of_all(Parts parts) {
  parts.one_light = parts.few_lights = parts.few_materials = parts.few_primitives = true;
  return parts;
}

constexpr char diffuse[] = "parallelograms light_planar";
constexpr char glossy[] = "parallelograms spheres phong_lobe light_planar";
constexpr char ambient[] = "parallelograms spheres phong_lobe black light_sphere ambient";
constexpr char triangles[] =
    "hierarchy triangles smooth_normals phong_lobe light_planar light_choice light_tree";
constexpr char sky[] = "spheres phong_lobe light_constant";

// The reflectance model alone.
Program phong_program(const std::string& name, const std::string& strategy, int width) {
  Parts parts = parts_of("phong_lobe", strategy);
  parts.lanes = width;
  Program program{fmt::format("{}-{}.{}", name, strategy, width), fmt::format("measure/{}.cl", name),
                  parts.defines()};
  program.defines["FIXED_DIRECTIONS"] = "16"; // of sampling.cl and figures.cl
  return program;
}

Program defining(Program program, const std::string& macro) {
  program.defines[macro] = "1";
  return program;
}

} // namespace

const std::vector<SceneProgram>& scene_programs() {
  static const std::vector<SceneProgram> list = {
      {"everything", everything()},
      {"everything-brute-force", without(everything(), "hierarchy")},
      {"diffuse-box", parts_of(diffuse, "cosine")},
      {"few-in-diffuse-box", few_of_all(parts_of(diffuse, "cosine"))},
      {"glossy-spheres", parts_of(glossy, "exact")},
      {"ambient", with_clamp(parts_of(ambient, "lobe-rho"))},
      {"mesh", connecting(parts_of(triangles, "lobe-ks"), Connect::light)},
      {"sphere-in-sky", connecting(parts_of(sky, "mixture"), Connect::none)},
      {"everything-light", by(Integrator::light, everything())},
      {"diffuse-box-light", by(Integrator::light, parts_of(diffuse, "cosine"))},
      {"glossy-spheres-light", by(Integrator::light, parts_of(glossy, "exact"))},
      {"sky-light", with_techniques(by(Integrator::light, parts_of(sky, "mixture")))},
      {"everything-bidir", by(Integrator::bidir, everything())},
      {"diffuse-box-bidir", by(Integrator::bidir, parts_of(diffuse, "cosine"))},
      {"glossy-spheres-bidir",
       with_roulette_of_connections(by(Integrator::bidir, parts_of(glossy, "exact"), Weights::power))},
      {"glossy-spheres-bidir-clamp", with_clamp(by(Integrator::bidir, parts_of(glossy, "exact")))},
      {"mesh-bidir",
       with_techniques(by(Integrator::bidir, parts_of(triangles, "lobe-ks"), Weights::uniform))},
      {"everything-double", in_double(everything())},
      {"glossy-spheres-bidir-double", in_double(by(Integrator::bidir, parts_of(glossy, "exact")))}};
  return list;
}

Program program_of(const SceneProgram& scene, int width) {
  Parts parts = scene.parts;
  parts.lanes = width;
  return {fmt::format("{}.{}", scene.name, width), parts.file(), parts.defines()};
}

std::vector<Program> programs() {
  std::vector<Program> list;
  for (const int width : {1, 4, 8, 16}) {
    for (const SceneProgram& scene : scene_programs())
      if (width == 1 || !scene.parts.double_precision) list.push_back(program_of(scene, width));
    for (const std::string& strategy : render::strategy_names())
      list.push_back(phong_program("sampling", strategy, width));
    list.push_back(phong_program("figures", "exact", width));
    list.push_back(phong_program("arithmetic", "exact", width));
    list.push_back(defining(phong_program("arithmetic", "fold", width), "PHLUX_NATIVE"));
    list.back().name = fmt::format("arithmetic-native.{}", width);
    list.push_back(defining(phong_program("verify", "exact", width), "PHLUX_GIVEN_WORDS"));
    list.push_back(program_of({"rays", everything()}, width));
    list.back().root = "measure/rays.cl";
  }
  return list;
}

std::vector<Ablation> ablations(Integrator integrator) {
  Parts all = everything(integrator);
  all.ambient = integrator == Integrator::path;
  all.connections = 2; // a part that only some programs of bidir have
  std::vector<Ablation> list = {{"", all}};
  for (const std::string& name : all.names()) list.push_back({name, without(all, name)});
  return list;
}

} // namespace phlux::test
