// Writes the text of programs as a device's compiler would get it, into FOLDER/NAME.WIDTH.cl, for check.sh.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <string>

#include "device/program.h"
#include "render/parts.h"

namespace {

using phlux::lobes::shipped;
using phlux::render::Connect;
using phlux::render::Integrator;
using phlux::render::Parts;
using phlux::render::Weights;

Parts everything() {
  Parts parts;
  for (const auto part : {&Parts::hierarchy, &Parts::triangles, &Parts::parallelograms, &Parts::ellipses,
                          &Parts::spheres, &Parts::smooth_normals, &Parts::two_sided, &Parts::light_planar,
                          &Parts::light_sphere, &Parts::light_point, &Parts::light_spot,
                          &Parts::light_directional, &Parts::light_constant, &Parts::light_choice})
    parts.*part = true;
  parts.models = {shipped("anisotropicphong"), shipped("conductor"), shipped("phong")};
  parts.strategy = "exact";
  return parts;
}

Parts everything_brute_force() {
  Parts parts = everything();
  parts.hierarchy = false;
  parts.strategy = "lobe-rho";
  return parts;
}

Parts diffuse_box() {
  Parts parts;
  parts.parallelograms = parts.light_planar = true;
  parts.strategy = "cosine";
  return parts;
}

Parts glossy_spheres() {
  Parts parts = diffuse_box();
  parts.spheres = true;
  parts.models = {shipped("phong")};
  parts.strategy = "exact";
  return parts;
}

Parts mesh() {
  Parts parts;
  parts.hierarchy = parts.triangles = parts.smooth_normals = true;
  parts.models = {shipped("phong")};
  parts.light_planar = parts.light_choice = true;
  parts.connect = Connect::light;
  parts.strategy = "lobe-ks";
  return parts;
}

Parts sphere_in_sky() {
  Parts parts;
  parts.spheres = parts.light_constant = true;
  parts.models = {shipped("phong")};
  parts.connect = Connect::none;
  parts.strategy = "mixture";
  return parts;
}

Parts by(Integrator integrator, Parts parts, Weights weights = Weights::balance) {
  parts.integrator = integrator;
  parts.weights = weights;
  parts.connect = integrator == Integrator::light ? Connect::none : Connect::mis;
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

// A program without a scene, which measures a reflectance model by a strategy.
Parts phong(const std::string& strategy) {
  Parts parts;
  parts.models = {shipped("phong")};
  parts.strategy = strategy;
  return parts;
}

bool write(const std::filesystem::path& folder, const std::string& name, const std::string& root, int lanes,
           Parts parts) {
  parts.lanes = lanes;
  phlux::device::ProgramSource source = parts.source(root);
  source.defines["FIXED_DIRECTIONS"] = "16";
  std::ofstream file(folder / (name + "." + std::to_string(lanes) + ".cl"));
  file << phlux::device::expand({}, source);
  return static_cast<bool>(file.flush());
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_programs FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const std::map<std::string, Parts> programs{
      {"everything", everything()},
      {"everything-brute-force", everything_brute_force()},
      {"diffuse-box", diffuse_box()},
      {"glossy-spheres", glossy_spheres()},
      {"mesh", mesh()},
      {"sphere-in-sky", sphere_in_sky()},
      {"everything-light", by(Integrator::light, everything())},
      {"glossy-spheres-light", by(Integrator::light, glossy_spheres())},
      {"sky-light", with_techniques(by(Integrator::light, sphere_in_sky()))},
      {"everything-bidir", by(Integrator::bidir, everything())},
      {"glossy-spheres-bidir", by(Integrator::bidir, glossy_spheres(), Weights::power)},
      {"mesh-bidir", with_techniques(by(Integrator::bidir, mesh(), Weights::uniform))},
      {"everything-double", in_double(everything())},
      {"glossy-spheres-bidir-double", in_double(by(Integrator::bidir, glossy_spheres()))}};
  bool good = true;
  for (const int lanes : {1, 4, 8, 16}) {
    for (const auto& [name, parts] : programs) {
      if (parts.double_precision && lanes != 1) continue;
      good = good && write(folder, name, parts.file(), lanes, parts);
    }
    for (const std::string& strategy : phlux::render::strategy_names())
      good = good && write(folder, "sampling-" + strategy, "measure/sampling.cl", lanes, phong(strategy));
    good = good && write(folder, "figures", "measure/figures.cl", lanes, phong("exact"));
    good = good && write(folder, "arithmetic", "measure/arithmetic.cl", lanes, phong("exact"));
  }
  return good ? 0 : 1;
}
