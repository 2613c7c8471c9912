#include "random/random_shapes.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace phlux::test {

using scene::Vec3;

RandomShapes::RandomShapes(SceneDraft& draft, Walls walls, RandomMaterials& materials, RandomLights& lights)
    : draft_(draft), kind_of_walls_(walls), reach_(draft.closed ? 0.6 : 0.4), materials_(materials),
      lights_(lights) {}

void RandomShapes::write() {
  walls();
  const int objects = (kind_of_walls_ == Walls::none ? 2 : 1) + draft_.structure.below(3);
  for (int i = 0; i < std::max(objects, lights_.lamps()); ++i) object(i < lights_.lamps(), i);
}

void RandomShapes::open(const std::string& type) {
  draft_.text.open("shape", fmt::format("type=\"{}\"", type));
}

// A room of half edge 1 about the origin, seen from inside.
void RandomShapes::walls() {
  RandomNumbers& values = draft_.values;
  if (kind_of_walls_ == Walls::floor) wall({0, -1, 0}, values.uniform(1, 4));
  if (kind_of_walls_ == Walls::rectangles)
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        Vec3 center(0.0);
        center[axis] = side;
        wall(center, 1);
      }
  if (kind_of_walls_ != Walls::mesh && kind_of_walls_ != Walls::sphere) return;
  open(kind_of_walls_ == Walls::mesh ? "ply" : "sphere");
  if (kind_of_walls_ == Walls::mesh) {
    mesh_file("room.ply", random_room(values));
  } else {
    draft_.text.boolean("flip_normals", true);
    draft_.text.real("radius", 1.7);
  }
  draft_.open_to_world();
  draft_.close_to_world();
  materials_.refer_to_one();
  draft_.text.close("shape");
}

void RandomShapes::wall(const Vec3& center, double half) {
  open("rectangle");
  draft_.open_to_world();
  if (half != 1) draft_.text.line(fmt::format("<scale value=\"{}\"/>", SceneText::number(half)));
  draft_.text.line(look_at("lookat", center, Vec3(0.0), up_for(center)));
  draft_.close_to_world();
  materials_.refer_to_one();
  draft_.text.close("shape");
}

void RandomShapes::object(bool lamp, int index) {
  RandomNumbers& values = draft_.values;
  SceneText& text = draft_.text;
  const std::string type = draft_.structure.pick<std::string>(
      {"rectangle", "cube", "disk", "sphere", "obj", "ply", "obj", "ply", "obj", "ply"});
  double size = lamp ? values.log_uniform(0.03, 0.4) : values.uniform(0.25, draft_.closed ? 0.6 : 0.9);
  if (lamp && draft_.twin) size = std::max(size, draft_.twin->least_lamp);
  const bool grouped = draft_.further.chance(0.2) && !lamp;
  if (grouped) text.open("shape", fmt::format("type=\"shapegroup\" id=\"group{}\"", index));
  open(type);
  if (type == "obj" || type == "ply") mesh(type, index);
  if (values.chance(0.2)) text.boolean("flip_normals", true);
  if (type == "sphere" && values.chance(0.5) && !grouped) {
    ball(size);
  } else {
    draft_.open_to_world();
    steps_to_place(type, size);
    grouped ? text.close("transform") : draft_.close_to_world();
  }
  if (!lamp || draft_.structure.chance(0.5)) materials_.refer_to_one(lamp);
  if (lamp) {
    text.open("emitter", "type=\"area\"");
    text.color("radiance", lights_.color() / (size * size));
    text.close("emitter");
  }
  text.close("shape");
  if (!grouped) return;
  text.close("shape");
  instance(type, index, false);
  if (values.chance(0.5)) instance(type, index, true);
}

// The group as it is, or somewhere else.
void RandomShapes::instance(const std::string& type, int group, bool elsewhere) {
  open("instance");
  draft_.text.line(fmt::format("<ref id=\"group{}\"/>", group));
  draft_.open_to_world();
  if (elsewhere) steps_to_place(type, draft_.values.uniform(0.4, 0.8));
  draft_.close_to_world();
  draft_.text.close("shape");
}

void RandomShapes::ball(double size) {
  draft_.text.point("center", draft_.in_world(triple(draft_.values, -reach_, reach_)));
  draft_.text.real("radius", draft_.scale * size);
}

void RandomShapes::steps_to_place(const std::string& type, double size) {
  RandomNumbers& values = draft_.values;
  SceneText& text = draft_.text;
  const bool similar = type == "sphere" || values.chance(0.4);
  if (similar) {
    text.line(fmt::format("<scale value=\"{}\"/>", SceneText::number(size)));
  } else {
    Vec3 sizes = size * triple(values, 0.4, 1.2);
    if (values.chance(0.2)) sizes.x = -sizes.x;
    text.triple("scale", sizes);
  }
  const int turns = 1 + values.below(2);
  for (int i = 0; i < turns; ++i) {
    const Vec3 axis = unit_vector(values);
    text.line(fmt::format("<rotate {} angle=\"{}\"/>", attribute("value", axis),
                          SceneText::number(values.uniform(-180, 180))));
  }
  if (!similar && values.chance(0.3)) {
    const Vec3 shear = triple(values, -0.4, 0.4);
    text.line(fmt::format("<matrix value=\"1 {} {} 0 1 {} 0 0 1\"/>", SceneText::number(shear.x),
                          SceneText::number(shear.y), SceneText::number(shear.z)));
  }
  const Vec3 place = triple(values, -reach_, reach_);
  if (values.chance(0.7)) {
    text.triple("translate", place);
    return;
  }
  const Vec3 forward = unit_vector(values), up = unit_vector(values);
  text.line(look_at("lookat", place, place + forward, up));
}

void RandomShapes::mesh(const std::string& type, int index) {
  RandomNumbers& structure = draft_.structure;
  const auto shape = structure.pick(
      {MeshShape::tetrahedron, MeshShape::octahedron, MeshShape::icosahedron, MeshShape::sheet});
  const bool flat = structure.chance(0.2), with_normals = draft_.values.chance(0.5);
  const RandomMesh mesh = random_mesh(shape, with_normals, draft_.values);
  mesh_file(fmt::format("mesh{}.{}", index, type), mesh);
  if (flat) draft_.text.boolean("face_normals", true);
}

void RandomShapes::mesh_file(const std::string& name, const RandomMesh& mesh) {
  draft_.files[name] =
      name.ends_with(".obj")
          ? obj_file(mesh)
          : ply_file(mesh,
                     draft_.values.pick({PlyFormat::ascii, PlyFormat::little_endian, PlyFormat::big_endian}));
  draft_.text.string("filename", name);
}

} // namespace phlux::test
