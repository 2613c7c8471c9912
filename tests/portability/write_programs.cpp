// Writes the programs as a device's compiler receives them, for check.sh and live_code.py:
//   FOLDER/NAME.WIDTH.cl               all programs
//   FOLDER/scenes.txt                  a line for each of a scene: name, the parts that are on
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

void write_all(const std::filesystem::path& folder) {
  for (const Program& program : test::programs()) write(folder / (program.name + ".cl"), text_of(program));
  std::string scenes;
  for (const SceneProgram& scene : test::scene_programs()) {
    scenes += test::program_of(scene).name;
    for (const std::string& part : scene.parts.names()) scenes += " " + part;
    scenes += "\n";
  }
  write(folder / "scenes.txt", scenes);
  for (const Ablation& ablation : test::ablations()) {
    const std::string name = (ablation.part.empty() ? "all" : ablation.part) + ".cl";
    write(folder / "ablations" / ablation.base / name, text_of(test::program_of({"", ablation.parts})));
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
