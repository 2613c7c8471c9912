// Writes the text of programs as a device's compiler would get it, into FOLDER/NAME.WIDTH.cl, for check.sh.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <string>

#include "device/program.h"
#include "render/parts.h"

namespace {

using phlux::render::Connect;
using phlux::render::Integrator;
using phlux::render::Parts;
using phlux::render::Weights;

Parts everything() {
  Parts parts;
  for (const auto part :
       {&Parts::hierarchy, &Parts::planars, &Parts::triangles, &Parts::parallelograms, &Parts::ellipses,
        &Parts::spheres, &Parts::smooth_normals, &Parts::two_sided, &Parts::phong_lobe, &Parts::anisotropic,
        &Parts::emission, &Parts::light_planar, &Parts::light_sphere, &Parts::light_point, &Parts::light_spot,
        &Parts::light_directional, &Parts::light_constant, &Parts::light_choice})
    parts.*part = true;
  parts.strategy = "STRATEGY_EXACT";
  return parts;
}

Parts everything_brute_force() {
  Parts parts = everything();
  parts.hierarchy = false;
  parts.strategy = "STRATEGY_LOBE_RHO";
  return parts;
}

Parts diffuse_box() {
  Parts parts;
  parts.planars = parts.parallelograms = parts.emission = parts.light_planar = true;
  parts.strategy = "STRATEGY_COSINE";
  return parts;
}

Parts glossy_spheres() {
  Parts parts = diffuse_box();
  parts.spheres = parts.phong_lobe = true;
  parts.strategy = "STRATEGY_EXACT";
  return parts;
}

Parts mesh() {
  Parts parts;
  parts.hierarchy = parts.planars = parts.triangles = parts.smooth_normals = parts.phong_lobe = true;
  parts.emission = parts.light_planar = parts.light_choice = true;
  parts.connect = Connect::light;
  parts.strategy = "STRATEGY_LOBE_KS";
  return parts;
}

Parts sphere_in_sky() {
  Parts parts;
  parts.spheres = parts.phong_lobe = parts.light_constant = true;
  parts.connect = Connect::none;
  parts.strategy = "STRATEGY_MIXTURE";
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

// A scene-less program that measures the sampler.
std::map<std::string, std::string> sampler(const std::string& strategy) {
  return {{"STRATEGY", strategy}, {"HAS_PHONG_LOBE", "1"}, {"FIXED_DIRECTIONS", "16"}};
}

bool write(const std::filesystem::path& folder, const std::string& name, const std::string& root, int lanes,
           std::map<std::string, std::string> defines) {
  defines["WIDTH"] = std::to_string(lanes);
  std::ofstream file(folder / (name + "." + std::to_string(lanes) + ".cl"));
  file << phlux::device::expand({}, {root, defines, ""});
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
    for (auto [name, parts] : programs) {
      if (parts.double_precision && lanes != 1) continue;
      parts.lanes = lanes;
      good = good && write(folder, name, parts.file(), lanes, parts.defines());
    }
    for (const std::string strategy : {"EXACT", "REJECTION", "FOLD", "LOBE_ESTIMATE", "DISK"})
      good = good &&
             write(folder, "sampling-" + strategy, "sampling.cl", lanes, sampler("STRATEGY_" + strategy));
    good = good && write(folder, "figures", "figures.cl", lanes, sampler("STRATEGY_EXACT"));
    good = good && write(folder, "arithmetic", "arithmetic.cl", lanes, {{"HAS_PHONG_LOBE", "1"}});
  }
  return good ? 0 : 1;
}
