// Writes the text of programs as a device's compiler would get it, for check.sh and live_code.py:
//   FOLDER/NAME.WIDTH.cl                     all programs
//   FOLDER/scenes.txt                 a line for each of a scene: name, integrator's file, the parts that are
//   on FOLDER/ablations/FILE/PART.cl     WIDTH 1, what an integrator's file is without a part; `all`: with
//   every part
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include "device/program.h"
#include "portability/programs.h"

namespace {

using namespace phlux;
using test::Ablation;
using test::Program;
using test::SceneProgram;

void write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

std::string text_of(const Program& program) {
  return device::expand({}, program.source);
}

std::string integrator_of(const render::Parts& parts) {
  return std::filesystem::path(parts.file()).stem();
}

void write_all(const std::filesystem::path& folder) {
  for (const Program& program : test::programs()) write(folder / (program.name + ".cl"), text_of(program));
  std::string scenes;
  for (const SceneProgram& scene : test::scene_programs()) {
    scenes += test::program_of(scene).name + " " + integrator_of(scene.parts);
    for (const std::string& part : scene.parts.names()) scenes += " " + part;
    scenes += "\n";
  }
  write(folder / "scenes.txt", scenes);
  for (const auto integrator :
       {render::Integrator::path, render::Integrator::light, render::Integrator::bidir})
    for (const Ablation& ablation : test::ablations(integrator)) {
      const std::string name = (ablation.part.empty() ? "all" : ablation.part) + ".cl";
      write(folder / "ablations" / integrator_of(ablation.parts) / name,
            text_of(test::program_of({"", ablation.parts})));
    }
}

} // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: write_programs FOLDER\n";
    return 2;
  }
  std::filesystem::remove_all(argv[1]);
  write_all(argv[1]);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
