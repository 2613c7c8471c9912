// A scene's kernel holds what the scene needs and nothing else.
#include <algorithm>
#include <map>

#include <catch2/catch.hpp>

#include "device/program.h"
#include "images/scenes.h"
#include "render/device_scene.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::test;
using Names = std::vector<std::string>;

namespace {

render::Parts parts_of(const scene::Scene& scene, render::Connect connect = render::Connect::mis) {
  constexpr int lanes = 8;
  render::Settings with;
  with.connect = connect;
  const render::HostScene host = render::prepare(scene, with.traversal, lanes);
  return render::find_parts(scene, host.geometry, host.lights, with, lanes);
}

std::string program_of(const render::Parts& parts, const device::KernelFiles& files = device::KernelFiles()) {
  return device::significant(device::expand(files, {"path.cl", parts.defines(), {}}));
}

// What stands in a program just for one part.
const std::map<std::string, Names> marks = {
    {"hierarchy", {"push_children", "scene->nodes"}},
    {"triangles", {"CLOSEST_OF(in_triangle,", "== REGION_TRIANGLE;"}},
    {"parallelograms", {"CLOSEST_OF(in_parallelogram,"}},
    {"ellipses", {"CLOSEST_OF(in_ellipse,"}},
    {"spheres", {"cross_sphere", "gather_sphere", "SphereShape"}},
    {"planars", {"cross_plane", "gather_planar"}},
    {"smooth_normals", {"interpolated_normal", "vertex_normals"}},
    {"phong_lobe", {"log1p", "expm1", "phong_lobe", "cosine_power"}},
    {"anisotropic", {"anisotropic_"}},
    {"emission", {"Mask emits"}},
    {"light_planar", {"sample_planar_light"}},
    {"light_sphere", {"sample_sphere_light", "one_minus_cone_cosine"}},
    {"light_spot", {"inv_transition)", "acos("}},
    {"light_choice", {"alias_threshold)"}},
    {"light_tree", {"light_nodes", "choose_from_tree"}},
};

bool holds(const std::string& text, const std::string& mark) {
  return text.find(mark) != std::string::npos;
}

} // namespace

TEST_CASE("the parts of each shipped scene are just what is in it") {
  const std::map<std::string, Names> expected = {
      {"caustic",
       {"planars", "parallelograms", "ellipses", "spheres", "two_sided", "black", "phong_lobe", "emission",
        "light_planar"}},
      {"cornell-box",
       {"planars", "parallelograms", "spheres", "black", "phong_lobe", "emission", "light_planar"}},
      {"furnace-box", {"planars", "parallelograms", "emission", "light_planar", "light_choice"}},
      {"furnace-sphere", {"spheres", "phong_lobe", "light_constant"}},
      {"glossy-box",
       {"planars", "parallelograms", "spheres", "black", "phong_lobe", "emission", "light_planar"}},
      {"mesh",
       {"hierarchy", "planars", "triangles", "parallelograms", "smooth_normals", "black", "phong_lobe",
        "emission", "light_planar", "light_constant", "light_choice"}},
      {"point-light", {"planars", "parallelograms", "spheres", "phong_lobe", "light_point"}},
      {"two-phong-spheres",
       {"planars", "parallelograms", "spheres", "black", "phong_lobe", "emission", "light_planar"}},
  };
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    REQUIRE(expected.contains(name));
    CHECK(parts_of(shipped(name, 4, 4)).names() == expected.at(name));
  }
  const Render image = render_of(shipped("cornell-box", 4, 4), settings(1));
  CHECK(image.statistics.parts == expected.at("cornell-box"));
}

TEST_CASE("a program holds the code of its scene's parts and of no other") {
  for (const std::string& name : shipped_names()) {
    const render::Parts parts = parts_of(shipped(name, 4, 4));
    const Names present = parts.names();
    const std::string program = program_of(parts);
    for (const auto& [part, texts] : marks)
      if (std::ranges::find(present, part) == present.end())
        for (const std::string& mark : texts) {
          CAPTURE(name, part, mark);
          CHECK_FALSE(holds(program, mark));
        }
  }
}

TEST_CASE("the marks of the parts are in the kernels, so that their absence says something") {
  std::string all;
  for (const auto& entry : std::filesystem::directory_iterator(PHLUX_SOURCE_DIR "/kernels"))
    all += TemporaryFolder::read(entry.path());
  for (const auto& [part, texts] : marks) {
    CAPTURE(part, texts);
    CHECK(std::ranges::any_of(texts, [&](const std::string& mark) { return holds(all, mark); }));
  }
}

TEST_CASE("a diffuse scene lit by hits alone has neither lobe nor light samples") {
  const std::string program = program_of(parts_of(shipped("furnace-box", 4, 4), render::Connect::none));
  for (const char* absent : {"light_sample(", "add_light_sample", "LightSample", "log1p", "choose_light"}) {
    CAPTURE(absent);
    CHECK_FALSE(holds(program, absent));
  }
  CHECK(holds(program, "trace_paths"));
}

TEST_CASE("where all connections are made there is no roulette for them") {
  const scene::Scene scene = shipped("cornell-box", 4, 4);
  render::Settings with;
  with.integrator = "bidir";
  const render::HostScene host = render::prepare(scene, with.traversal, 8);
  const auto program = [&] {
    const render::Parts parts = render::find_parts(scene, host.geometry, host.lights, with, 8);
    return device::significant(device::expand(device::KernelFiles(), {"bidir.cl", parts.defines(), {}}));
  };
  CHECK(holds(program(), "further_word(pair"));
  with.techniques = true;
  CHECK_FALSE(holds(program(), "further_word(pair"));
  with.techniques = false;
  with.connections = 0;
  CHECK_FALSE(holds(program(), "further_word(pair"));
}

TEST_CASE("a feature that nobody uses leaves the programs of other scenes as they were") {
  const TemporaryFolder folder;
  std::filesystem::copy(PHLUX_SOURCE_DIR "/kernels", folder.path(), std::filesystem::copy_options::recursive);
  folder.write("velvet.cl", "#ifndef PHLUX_VELVET_CL\n#define PHLUX_VELVET_CL\n"
                            "static inline Real velvet(Real x) { return 1.0f - x; }\n#endif\n");
  std::string material = TemporaryFolder::read(folder / "material.cl");
  const std::string anchor = "#include \"phong.cl\"\n";
  const auto at = material.find(anchor);
  REQUIRE(at != std::string::npos);
  material.insert(at + anchor.size(),
                  "// Velvet is new.\n#ifdef PHLUX_VELVET\n#include \"velvet.cl\"\n#endif\n");
  folder.write("material.cl", material);
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const render::Parts parts = parts_of(shipped(name, 4, 4));
    const device::KernelFiles files((std::filesystem::path(PHLUX_SOURCE_DIR) / "kernels"));
    CHECK(program_of(parts, device::KernelFiles(folder.path())) == program_of(parts, files));
  }
  auto defines = parts_of(shipped("furnace-box", 4, 4)).defines();
  defines["PHLUX_VELVET"] = "1";
  CHECK(holds(device::expand(device::KernelFiles(folder.path()), {"path.cl", defines, {}}), "velvet("));
}
