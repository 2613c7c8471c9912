#include "random/random_scene.h"

#include <fstream>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "random/random_shapes.h"
#include "scene_file/load.h"
#include "temporary_folder.h"

namespace phlux::test {
namespace {

using scene::Vec3;

void choose_world(SceneDraft& draft) {
  RandomNumbers& values = draft.values;
  draft.scale = values.log_uniform(1e-3, 1e3);
  if (!values.chance(0.4)) return;
  const Vec3 direction = unit_vector(values);
  draft.offset = draft.scale * values.log_uniform(0.1, 100) * direction;
}

Walls choose_walls(SceneDraft& draft) {
  const Walls kind = draft.structure.pick({Walls::none, Walls::floor, Walls::floor, Walls::rectangles,
                                           Walls::rectangles, Walls::mesh, Walls::sphere});
  draft.closed = kind != Walls::none && kind != Walls::floor;
  return kind;
}

void write_integrator(SceneDraft& draft, bool hides_emitters) {
  RandomNumbers& values = draft.values;
  draft.text.open("integrator", fmt::format("type=\"{}\"", values.pick({"path", "ptracer", "bdpt"})));
  draft.text.integer("max_depth", values.chance(0.04) ? 1 : values.pick({2, 3, 3, 4, 4, 5, 8, -1, -1}));
  draft.text.integer("rr_depth", values.pick({1, 2, 3, 5}));
  if (values.chance(0.5)) draft.text.boolean("strict_normals", values.chance(0.7));
  if (hides_emitters) draft.text.boolean("hide_emitters", true);
  draft.text.close("integrator");
}

void write_camera_place(SceneDraft& draft, bool orthographic) {
  RandomNumbers& values = draft.values;
  const Vec3 from = draft.place([&](RandomNumbers& random) {
    return draft.closed ? triple(random, -0.75, 0.75) : above_floor(random, 1.6, 3);
  });
  const Vec3 to = draft.place([](RandomNumbers& random) { return triple(random, -0.3, 0.3); });
  draft.open_to_world();
  if (orthographic) {
    const std::string half_width = SceneText::number(draft.scale * values.uniform(0.3, 1.2));
    draft.text.line(fmt::format("<scale x=\"{0}\" y=\"{0}\"/>", half_width));
  }
  if (values.chance(0.2)) draft.text.line("<scale x=\"-1\"/>");
  if (values.chance(0.2)) {
    draft.text.line("<rotate y=\"1\" angle=\"180\"/>");
    draft.text.triple("translate", draft.in_world(from));
  } else {
    Vec3 up = up_for(to - from);
    if (values.chance(0.3)) up = glm::normalize(up + 0.5 * unit_vector(values));
    draft.text.line(look_at(values.pick({"lookat", "lookAt"}), draft.in_world(from), draft.in_world(to), up));
  }
  draft.text.close("transform");
}

void write_field_of_view(SceneDraft& draft) {
  RandomNumbers& values = draft.values;
  SceneText& text = draft.text;
  text.real("fov", draft.place([](RandomNumbers& random) {
    return random.chance(0.8) ? random.uniform(30, 100) : random.uniform(2, 165);
  }));
  if (values.chance(0.6)) text.string("fov_axis", values.pick({"x", "y", "diagonal", "smaller", "larger"}));
  if (values.chance(0.2)) text.real("principal_point_offset_x", values.uniform(-0.3, 0.3));
  if (values.chance(0.2)) text.real("principal_point_offset_y", values.uniform(-0.3, 0.3));
}

void write_filter(SceneDraft& draft) {
  const std::string type = draft.further.pick<std::string>({"box", "box", "tent", "gaussian"});
  draft.text.open("rfilter", fmt::format("type=\"{}\"", type));
  if (type == "tent") draft.text.real("radius", draft.values.uniform(0.3, 2));
  if (type == "gaussian") draft.text.real("stddev", draft.values.uniform(0.2, 1));
  draft.text.close("rfilter");
}

void write_sensor(SceneDraft& draft) {
  RandomNumbers& values = draft.values;
  SceneText& text = draft.text;
  const std::string type =
      draft.further.pick<std::string>({"perspective", "perspective", "thinlens", "orthographic"});
  text.open("sensor", fmt::format("type=\"{}\"", type));
  if (type != "orthographic") write_field_of_view(draft);
  if (type == "thinlens") {
    text.real("aperture_radius", draft.scale * values.uniform(0.02, 0.15));
    text.real("focus_distance", draft.scale * values.uniform(1, 3));
  }
  write_camera_place(draft, type == "orthographic");
  text.open("sampler", "type=\"independent\"");
  text.integer("sample_count", 4);
  text.close("sampler");
  text.open("film", "type=\"hdrfilm\"");
  text.integer("width", 4 + values.below(11));
  text.integer("height", 4 + values.below(9));
  write_filter(draft);
  text.close("film");
  text.close("sensor");
}

} // namespace

double most_exponent(std::uint64_t family) {
  return RandomNumbers(~family).pick({100.0, 100.0, 1e4, 1e6});
}

std::string name_of(const SceneNumber& number) {
  return fmt::format("{}-{}", number.family, number.member);
}

RandomScene random_scene(const SceneNumber& number, const std::optional<Twin>& twin) {
  SceneDraft draft(number, twin);
  choose_world(draft);
  RandomLights lights(draft);
  RandomMaterials materials(draft, most_exponent(number.family));
  const Walls walls = choose_walls(draft);
  write_integrator(draft, RandomNumbers(number.family << 16).chance(0.1));
  write_sensor(draft);
  materials.write();
  lights.write();
  RandomShapes(draft, walls, materials, lights).write();
  return {draft.text.text(), std::move(draft.files)};
}

std::filesystem::path write_scene(const RandomScene& scene, const std::filesystem::path& folder,
                                  const std::string& name) {
  std::filesystem::create_directories(folder);
  for (const auto& [file, bytes] : scene.files) std::ofstream(folder / file, std::ios::binary) << bytes;
  const std::filesystem::path path = folder / (name + ".xml");
  std::ofstream(path) << scene.xml;
  return path;
}

scene::Scene load_random_scene(const SceneNumber& number, const std::optional<Twin>& twin) {
  const TemporaryFolder folder;
  return scene_file::load(write_scene(random_scene(number, twin), folder.path(), name_of(number)));
}

} // namespace phlux::test
