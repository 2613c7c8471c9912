#include "random/random_scene.h"

#include <algorithm>
#include <fstream>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "random/random_mesh.h"
#include "random/random_numbers.h"
#include "random/scene_text.h"
#include "scene_file/load.h"
#include "temporary_folder.h"

namespace phlux::test {
namespace {

using scene::Rgb;
using scene::Vec3;

constexpr double tiny_exponent = 0.1; ///< where drawing exponents by their logarithms begins

enum class Walls { none, floor, rectangles, mesh, sphere };

Vec3 triple(RandomNumbers& random, double from, double to) {
  return {random.uniform(from, to), random.uniform(from, to), random.uniform(from, to)};
}

Vec3 unit_vector(RandomNumbers& random) {
  while (true) {
    const Vec3 v = triple(random, -1, 1);
    const double square = glm::dot(v, v);
    if (square > 0.01 && square < 1) return v / std::sqrt(square);
  }
}

// A direction across `axis`.
Vec3 up_for(const Vec3& axis) {
  return std::abs(axis.y) < 0.9 * glm::length(axis) ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
}

std::string attribute(const char* name, const Vec3& value) {
  return fmt::format("{}=\"{}\"", name, SceneText::numbers(value));
}

// Draws what decides over the kernel from `structure_`, all else from `values_`. Lengths are in units of the
// room's half edge until place_in_world() scales and moves them.
class Generator {
public:
  explicit Generator(const SceneNumber& number)
      : structure_(number.family), values_(1'000'003 * (number.member + 1) + (number.family << 24)),
        most_exponent_(most_exponent(number.family)),
        text_(structure_.pick<std::string>({"0.5.0", "0.6.0", "2.0.0", "3.0.0"}), values_) {}

  RandomScene scene() {
    scale_ = values_.log_uniform(1e-3, 1e3);
    if (values_.chance(0.4)) {
      const Vec3 direction = unit_vector(values_);
      offset_ = scale_ * values_.log_uniform(0.1, 100) * direction;
    }
    radiance_ = values_.chance(0.9) ? values_.log_uniform(1e-2, 1e2) : values_.log_uniform(1e-8, 1e8);
    walls_kind_ = structure_.pick({Walls::none, Walls::floor, Walls::floor, Walls::rectangles,
                                   Walls::rectangles, Walls::mesh, Walls::sphere});
    closed_ = walls_kind_ != Walls::none && walls_kind_ != Walls::floor;
    reach_ = closed_ ? 0.6 : 0.4;
    integrator();
    sensor();
    materials();
    lights();
    walls();
    const int objects = (walls_kind_ == Walls::none ? 2 : 1) + structure_.below(3);
    for (int i = 0; i < objects; ++i) object(i < lamps_, i);
    for (int i = objects; i < lamps_; ++i) object(true, i);
    return {text_.text(), std::move(meshes_)};
  }

private:
  void integrator() {
    text_.open("integrator", fmt::format("type=\"{}\"", values_.pick({"path", "ptracer", "bdpt"})));
    text_.integer("max_depth", values_.chance(0.04) ? 1 : values_.pick({2, 3, 3, 4, 4, 5, 8, -1, -1}));
    text_.integer("rr_depth", values_.pick({1, 2, 3, 5}));
    text_.close("integrator");
  }

  void sensor() {
    text_.open("sensor", "type=\"perspective\"");
    text_.real("fov", values_.chance(0.8) ? values_.uniform(30, 100) : values_.uniform(2, 165));
    if (values_.chance(0.6))
      text_.string("fov_axis", values_.pick({"x", "y", "diagonal", "smaller", "larger"}));
    if (values_.chance(0.2)) text_.real("principal_point_offset_x", values_.uniform(-0.3, 0.3));
    if (values_.chance(0.2)) text_.real("principal_point_offset_y", values_.uniform(-0.3, 0.3));
    camera_place();
    text_.open("sampler", "type=\"independent\"");
    text_.integer("sample_count", 4);
    text_.close("sampler");
    text_.open("film", "type=\"hdrfilm\"");
    text_.integer("width", 4 + values_.below(11));
    text_.integer("height", 4 + values_.below(9));
    text_.line("<rfilter type=\"box\"/>");
    text_.close("film");
    text_.close("sensor");
  }

  void camera_place() {
    const Vec3 from = closed_ ? triple(values_, -0.75, 0.75) : above_floor(1.6, 3);
    const Vec3 to = triple(values_, -0.3, 0.3);
    text_.open("transform", fmt::format("name=\"{}\"", text_.spelling("to_world")));
    if (values_.chance(0.2)) text_.line("<scale x=\"-1\"/>");
    if (values_.chance(0.2)) {
      text_.line("<rotate y=\"1\" angle=\"180\"/>");
      text_.triple("translate", in_world(from));
    } else {
      Vec3 up = up_for(to - from);
      if (values_.chance(0.3)) up = glm::normalize(up + 0.5 * unit_vector(values_));
      text_.line(fmt::format("<{} {} {} {}/>", values_.pick({"lookat", "lookAt"}),
                             attribute("origin", in_world(from)), attribute("target", in_world(to)),
                             attribute("up", up)));
    }
    text_.close("transform");
  }

  // Above the floor and before the objects, between two distances from the origin.
  Vec3 above_floor(double nearest, double farthest) {
    Vec3 v = unit_vector(values_);
    v.y = std::abs(v.y);
    v.z = std::abs(v.z) + 0.2;
    return values_.uniform(nearest, farthest) * glm::normalize(v);
  }

  [[nodiscard]] Vec3 in_world(const Vec3& p) const { return scale_ * p + offset_; }

  // ---- Materials

  void materials() {
    materials_ = 2 + structure_.below(3);
    for (int i = 0; i < materials_; ++i) {
      const bool two_sided = structure_.chance(0.4);
      const std::string id = fmt::format("id=\"material{}\"", i);
      if (two_sided) text_.open("bsdf", "type=\"twosided\" " + id);
      lobes(structure_.pick({"diffuse", "diffuse", "phong", "phong", "phong", "anisotropicphong"}),
            two_sided ? "" : " " + id);
      if (two_sided) text_.close("bsdf");
    }
  }

  void lobes(const std::string& type, const std::string& id) {
    text_.open("bsdf", fmt::format("type=\"{}\"{}", type, id));
    const bool black = structure_.chance(0.08), no_diffuse = structure_.chance(0.15);
    const bool grey = values_.chance(0.3);
    Rgb diffuse, specular;
    for (int c = 0; c < 3; ++c) {
      const double total = black ? 0 : values_.uniform(0.1, 0.99);
      const double share = no_diffuse ? 1 : values_.uniform();
      diffuse[c] = grey && c > 0 ? diffuse[0] : total * (1 - share);
      specular[c] = grey && c > 0 ? specular[0] : total * share;
    }
    if (type == "diffuse") {
      text_.color("reflectance", diffuse + specular);
    } else {
      if (values_.chance(0.1) && !black) { // as Mitsuba scales it
        text_.boolean("ensure_energy_conservation", true);
        diffuse *= 1.5;
        specular *= 1.5;
      }
      text_.color("diffuse_reflectance", diffuse);
      text_.color("specular_reflectance", specular);
      if (type == "phong") {
        text_.real("exponent", exponent());
      } else {
        text_.real("exponent_u", exponent());
        text_.real("exponent_v", exponent());
      }
    }
    text_.close("bsdf");
  }

  double exponent() {
    if (values_.chance(0.1)) return 0;
    if (values_.chance(0.1)) return most_exponent_;
    return values_.log_uniform(tiny_exponent, most_exponent_);
  }

  void material() { text_.line(fmt::format("<ref id=\"material{}\"/>", structure_.below(materials_))); }

  // ---- Lights

  Rgb light_color() {
    const Rgb tint = triple(values_, 0.2, 1);
    const double level = radiance_ * values_.log_uniform(0.3, 3);
    return level * (values_.chance(0.3) ? Rgb(tint.r) : tint);
  }

  // Closed rooms are lit from inside; one scene in 30 has no light.
  void lights() {
    if (structure_.chance(0.03)) return;
    const int count = 1 + structure_.below(3);
    for (int i = 0; i < count; ++i) {
      const std::string type =
          closed_
              ? structure_.pick<std::string>({"area", "area", "point", "spot"})
              : structure_.pick<std::string>({"area", "area", "point", "spot", "directional", "constant"});
      if (type == "area")
        ++lamps_;
      else if (type != "constant" || !sky_)
        emitter(type);
    }
  }

  void emitter(const std::string& type) {
    text_.open("emitter", fmt::format("type=\"{}\"", type));
    const Rgb color = light_color();
    if (type == "point") {
      text_.color("intensity", scale_ * scale_ * color);
      text_.point("position", in_world(lamp_place()));
    } else if (type == "spot") {
      spot(color);
    } else if (type == "directional") {
      text_.color("irradiance", color);
      text_.triple("vector name=\"direction\"", -above_floor(1, 2));
    } else {
      text_.color("radiance", 0.3 * color);
      sky_ = true;
    }
    text_.close("emitter");
  }

  void spot(const Rgb& color) {
    const Vec3 from = lamp_place(), to = triple(values_, -0.3, 0.3);
    text_.color("intensity", 3 * scale_ * scale_ * color);
    const double cutoff = values_.uniform(5, values_.chance(0.2) ? 180 : 60);
    text_.real("cutoff_angle", cutoff);
    if (values_.chance(0.6)) text_.real("beam_width", 0.999 * cutoff * values_.uniform());
    text_.open("transform", fmt::format("name=\"{}\"", text_.spelling("to_world")));
    text_.line(fmt::format("<lookat {} {} {}/>", attribute("origin", in_world(from)),
                           attribute("target", in_world(to)), attribute("up", up_for(to - from))));
    text_.close("transform");
  }

  Vec3 lamp_place() { return closed_ ? triple(values_, -0.6, 0.6) : above_floor(0.8, 2); }

  // ---- Shapes

  void open_shape(const std::string& type) { text_.open("shape", fmt::format("type=\"{}\"", type)); }
  void open_to_world() { text_.open("transform", fmt::format("name=\"{}\"", text_.spelling("to_world"))); }
  void place_in_world() {
    if (values_.chance(0.2)) {
      const double s = scale_;
      text_.line(fmt::format("<matrix value=\"{0} 0 0 {1}, 0 {0} 0 {2}, 0 0 {0} {3}, 0 0 0 1\"/>",
                             SceneText::number(s), SceneText::number(offset_.x), SceneText::number(offset_.y),
                             SceneText::number(offset_.z)));
    } else {
      text_.line(fmt::format("<scale value=\"{}\"/>", SceneText::number(scale_)));
      if (offset_ != Vec3(0.0)) text_.triple("translate", offset_);
    }
    text_.close("transform");
  }

  // A room of half edge 1 about the origin, seen from inside.
  void walls() {
    if (walls_kind_ == Walls::floor) wall({0, -1, 0}, values_.uniform(1, 4));
    if (walls_kind_ == Walls::rectangles)
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
          Vec3 center(0.0);
          center[axis] = side;
          wall(center, 1);
        }
    if (walls_kind_ != Walls::mesh && walls_kind_ != Walls::sphere) return;
    open_shape(walls_kind_ == Walls::mesh ? "ply" : "sphere");
    if (walls_kind_ == Walls::mesh) {
      mesh_file("room.ply", random_room(values_));
    } else {
      text_.boolean("flip_normals", true);
      text_.real("radius", 1.7);
    }
    open_to_world();
    place_in_world();
    material();
    text_.close("shape");
  }

  void wall(const Vec3& center, double half) {
    open_shape("rectangle");
    open_to_world();
    if (half != 1) text_.line(fmt::format("<scale value=\"{}\"/>", SceneText::number(half)));
    text_.line(fmt::format("<lookat {} {} {}/>", attribute("origin", center), attribute("target", Vec3(0.0)),
                           attribute("up", up_for(center))));
    place_in_world();
    material();
    text_.close("shape");
  }

  void object(bool lamp, int index) {
    const std::string type = structure_.pick<std::string>(
        {"rectangle", "cube", "disk", "sphere", "obj", "ply", "obj", "ply", "obj", "ply"});
    const double size = lamp ? values_.log_uniform(0.03, 0.4) : values_.uniform(0.25, closed_ ? 0.6 : 0.9);
    open_shape(type);
    if (type == "obj" || type == "ply") mesh(type, index);
    if (values_.chance(0.2)) text_.boolean("flip_normals", true);
    if (type == "sphere" && values_.chance(0.5)) {
      round_shape(size);
    } else {
      open_to_world();
      shape_steps(type, size);
      place_in_world();
    }
    if (!lamp || structure_.chance(0.5)) material();
    if (lamp) {
      text_.open("emitter", "type=\"area\"");
      text_.color("radiance", light_color() / (size * size));
      text_.close("emitter");
    }
    text_.close("shape");
  }

  void round_shape(double size) {
    text_.point("center", in_world(triple(values_, -reach_, reach_)));
    text_.real("radius", scale_ * size);
  }

  void shape_steps(const std::string& type, double size) {
    const bool similar = type == "sphere" || values_.chance(0.4);
    if (similar) {
      text_.line(fmt::format("<scale value=\"{}\"/>", SceneText::number(size)));
    } else {
      Vec3 sizes = size * triple(values_, 0.4, 1.2);
      if (values_.chance(0.2)) sizes.x = -sizes.x;
      text_.triple("scale", sizes);
    }
    const int turns = 1 + values_.below(2);
    for (int i = 0; i < turns; ++i) {
      const Vec3 axis = unit_vector(values_);
      text_.line(fmt::format("<rotate {} angle=\"{}\"/>", attribute("value", axis),
                             SceneText::number(values_.uniform(-180, 180))));
    }
    if (!similar && values_.chance(0.3)) {
      const Vec3 shear = triple(values_, -0.4, 0.4);
      text_.line(fmt::format("<matrix value=\"1 {} {} 0 1 {} 0 0 1\"/>", SceneText::number(shear.x),
                             SceneText::number(shear.y), SceneText::number(shear.z)));
    }
    const Vec3 place = triple(values_, -reach_, reach_);
    if (values_.chance(0.7)) {
      text_.triple("translate", place);
      return;
    }
    const Vec3 forward = unit_vector(values_), up = unit_vector(values_);
    text_.line(fmt::format("<lookat {} {} {}/>", attribute("origin", place),
                           attribute("target", place + forward), attribute("up", up)));
  }

  void mesh(const std::string& type, int index) {
    const auto shape = structure_.pick(
        {MeshShape::tetrahedron, MeshShape::octahedron, MeshShape::icosahedron, MeshShape::sheet});
    const bool flat = structure_.chance(0.2), with_normals = values_.chance(0.5);
    const RandomMesh mesh = random_mesh(shape, with_normals, values_);
    mesh_file(fmt::format("mesh{}.{}", index, type), mesh);
    if (flat) text_.boolean("face_normals", true);
  }

  void mesh_file(const std::string& name, const RandomMesh& mesh) {
    meshes_[name] =
        name.ends_with(".obj")
            ? obj_file(mesh)
            : ply_file(mesh,
                       values_.pick({PlyFormat::ascii, PlyFormat::little_endian, PlyFormat::big_endian}));
    text_.string("filename", name);
  }

  RandomNumbers structure_, values_;
  double most_exponent_;
  SceneText text_;
  std::map<std::string, std::string> meshes_;
  double scale_ = 1, radiance_ = 1, reach_ = 0.6;
  Vec3 offset_{0.0};
  Walls walls_kind_ = Walls::none;
  bool closed_ = false, sky_ = false;
  int materials_ = 0, lamps_ = 0;
};

} // namespace

double most_exponent(std::uint64_t family) {
  return RandomNumbers(~family).pick({100.0, 100.0, 1e4, 1e6});
}

std::string name_of(const SceneNumber& number) {
  return fmt::format("{}-{}", number.family, number.member);
}

RandomScene random_scene(const SceneNumber& number) {
  return Generator(number).scene();
}

std::filesystem::path write_scene(const RandomScene& scene, const std::filesystem::path& folder,
                                  const std::string& name) {
  std::filesystem::create_directories(folder);
  for (const auto& [file, bytes] : scene.meshes) std::ofstream(folder / file, std::ios::binary) << bytes;
  const std::filesystem::path path = folder / (name + ".xml");
  std::ofstream(path) << scene.xml;
  return path;
}

scene::Scene load_random_scene(const SceneNumber& number) {
  const TemporaryFolder folder;
  return scene_file::load(write_scene(random_scene(number), folder.path(), name_of(number)));
}

} // namespace phlux::test
