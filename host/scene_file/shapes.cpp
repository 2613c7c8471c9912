#include "scene_file/shapes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>
#include <glm/mat3x3.hpp>

#include "scene_file/cylinder.h"
#include "scene_file/emitters.h"
#include "scene_file/mesh.h"
#include "scene_file/properties.h"
#include "scene_file/transform.h"
#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

using scene::Patch;
using scene::Vec3;

bool mirrors(const glm::dmat4& matrix) {
  return glm::determinant(glm::dmat3(matrix)) < 0.0;
}

/// Texture coordinates change by half along these directions of the object, which are axes.
struct UvAxes {
  Vec3 u{1, 0, 0}, v{0, 1, 0};
};

/// Transforms a patch, with front side along cross(u, v), from the object to the world.
Patch transformed(const glm::dmat4& to_world, bool flip, Patch::Region region, const Vec3& origin,
                  const Vec3& u, const Vec3& v, const UvAxes& uv = {}) {
  const glm::dmat3 linear(to_world);
  Patch patch{region, Vec3(to_world * glm::dvec4(origin, 1.0)), linear * u, linear * v, {}};
  if (region == Patch::Region::ellipse) // x and y
    patch.uv = {glm::dvec2(0.0), glm::dvec2(1, 0), glm::dvec2(0, 1)};
  else
    patch.uv = {glm::dvec2(0.5), 0.5 * glm::dvec2(glm::dot(uv.u, u), glm::dot(uv.v, u)),
                0.5 * glm::dvec2(glm::dot(uv.u, v), glm::dot(uv.v, v))};
  // cross(M u, M v) = det(M) M^-T cross(u, v) points to the back if M mirrors.
  if (mirrors(to_world) != flip) { // both regions are symmetric
    patch.edge_v = -patch.edge_v;
    patch.uv[2] = -patch.uv[2];
  }
  return patch;
}

/// The faces of [-1, 1]^3, with the front outside: a face's origin is the cross product of its edges.
std::vector<Patch> cube(const glm::dmat4& to_world, bool flip) {
  // Of the faces at -x, +x, -y, +y, -z, +z: as Mitsuba's, without a rule.
  constexpr Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  static const std::array<UvAxes, 6> uv{{{y, z}, {y, -z}, {z, x}, {-x, -z}, {-y, x}, {y, x}}};
  std::vector<Patch> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3 normal(0.0), u(0.0), v(0.0);
      normal[axis] = side;
      u[(axis + 1) % 3] = 1.0;
      v[(axis + 2) % 3] = side;
      faces.push_back(
          transformed(to_world, flip, Patch::Region::parallelogram, normal, u, v, uv[faces.size()]));
    }
  return faces;
}

/// `own` is the transform of the shape, `to_world` with that of an instance in addition.
scene::Sphere sphere(Properties& properties, const glm::dmat4& own, const glm::dmat4& to_world) {
  scene::Sphere result;
  Vec3 center = properties.vector("center").value_or(Vec3(0.0));
  const double radius = properties.real("radius", 1.0);
  if (!(radius > 0.0))
    properties.fail_at("radius", std::to_string(radius) + " is not positive", "a radius above 0");
  if (!is_similarity(to_world))
    properties.fail_at("to_world", "it would turn the sphere into an ellipsoid",
                       "a uniform scale, rotations, translations");
  // 0.x scales the radius but not the centre.
  if (properties.document().major_version == 0) center /= glm::length(Vec3(own[0]));
  result.center = Vec3(to_world * glm::dvec4(center, 1.0));
  result.radius = radius * glm::length(Vec3(to_world[0]));
  if (!(glm::compMax(glm::abs(result.center)) + result.radius <= std::numeric_limits<float>::max()))
    properties.fail_at("radius", "the sphere is outside the range of single precision", "a smaller one");
  for (int axis = 0; axis < 3; ++axis)
    result.axes[static_cast<std::size_t>(axis)] = glm::normalize(Vec3(to_world[axis]));
  // From version 1 on a transform that mirrors turns the front inside; that of an instance does not.
  result.front_is_inside =
      properties.boolean("flip_normals", false) != (properties.document().major_version > 0 && mirrors(own));
  properties.pass_over({"face_normals"});
  return result;
}

/// What a shape refers to.
struct Attached {
  scene::Surface surface;
  std::map<std::string, int> materials; ///< obj: by the names that `usemtl` gives
  bool has_bsdf = false;                ///< one for the whole shape
};

/// Index of the material of `bsdf`; a material that cannot be read becomes a problem and black.
int material_of(const Element& bsdf, const Document& document, const ShapeTarget& target) {
  const auto known = target.materials.find(&bsdf);
  if (known != target.materials.end()) return known->second;
  scene::Material material = lobes::diffuse(scene::Rgb(0.0));
  document.problems->attempt([&] { material = read_material(bsdf, document, target.rules); });
  return target.materials[&bsdf] = target.shared.index_of(material);
}

int area_emitter_of(const Element& emitter, const Document& document, scene::Scene& scene) {
  const scene::AreaEmitter area = read_area_emitter(emitter, document);
  if (area.radiance == scene::Rgb(0.0)) return -1;
  scene.area_emitters.push_back(area);
  return static_cast<int>(scene.area_emitters.size()) - 1;
}

/// Mitsuba 0.x gives bsdfs with a name to the parts of an obj file that have this material.
bool has_named_bsdfs(const Properties& properties) {
  return properties.document().major_version == 0 && properties.element().type() == "obj";
}

Attached attached(Properties& properties, const ShapeTarget& target) {
  const Document& document = properties.document();
  Attached result;
  if (!has_named_bsdfs(properties)) static_cast<void>(properties.object("bsdf")); // one alone
  for (const auto& [name, bsdf] : properties.named_objects("bsdf")) {
    const int material = material_of(*bsdf, document, target);
    if (has_named_bsdfs(properties) && !name.empty() && name != "bsdf") {
      result.materials[name] = material;
      continue;
    }
    result.surface.material = material;
    result.has_bsdf = true;
    result.materials.clear(); // which came before: this one is for all parts
  }
  const Element* emitter = properties.object("emitter");
  if (!result.has_bsdf) // Mitsuba's default is grey 0.5, or black if the shape emits
    result.surface.material = target.shared.index_of(lobes::diffuse(scene::Rgb(emitter ? 0.0 : 0.5)));
  if (emitter)
    document.problems->attempt([&] {
      const auto material = static_cast<std::size_t>(result.surface.material);
      if (material < target.scene.materials.size() && target.scene.materials[material].is_masked())
        fail(emitter->where, "a masked shape that emits is not supported",
             "leave out the mask, or make of the shape only what is not masked");
      result.surface.area_emitter = area_emitter_of(*emitter, document, target.scene);
    });
  return result;
}

void read_mesh_shape(Properties& properties, const glm::dmat4& own, const Attached& attached,
                     const ShapeTarget& target) {
  properties.pass_over({"srgb"});
  if (properties.string("filename", "").empty())
    fail(properties.element().where, properties.element().name() + " without a filename",
         "<string name=\"filename\" .../>");
  MeshShape shape{{}, attached.surface, attached.materials};
  MeshRequest& request = shape.request;
  request.format = properties.element().type();
  request.file = properties.document().find(properties.string("filename", ""));
  request.named_at = properties.where("filename");
  request.warnings = properties.document().warnings;
  request.to_world = own;
  request.instance = target.instance;
  request.flip_normals = properties.boolean("flip_normals", false);
  request.face_normals = properties.boolean("face_normals", false);
  request.flip_tex_coords = properties.boolean("flip_tex_coords", request.format == "obj");
  const auto needs_uv = [&](int material) {
    return scene::needs_uv(target.scene.materials[static_cast<std::size_t>(material)]);
  };
  request.texture_coordinates =
      needs_uv(attached.surface.material) ||
      std::ranges::any_of(attached.materials, [&](const auto& named) { return needs_uv(named.second); });
  if (request.format != "ply") request.shape_index = properties.integer("shape_index", -1);
  const bool collapse = properties.boolean("collapse", false);
  const bool load_materials = properties.boolean("load_materials", true);
  if (has_named_bsdfs(properties) && !collapse) {
    request.separate_groups = true;
    shape.library_materials = load_materials && !attached.has_bsdf;
    request.parts = request.shape_index >= 0      ? ObjParts::by_groups
                    : !attached.materials.empty() ? ObjParts::by_materials
                    : shape.library_materials     ? ObjParts::by_library_materials
                                                  : ObjParts::one;
  }
  target.meshes.add(std::move(shape));
}

void read_patches(Properties& properties, const glm::dmat4& to_world, const scene::Surface& surface,
                  scene::Scene& scene) {
  const bool flip = properties.boolean("flip_normals", false);
  const std::string type = properties.element().type();
  const auto region = type == "disk" ? Patch::Region::ellipse : Patch::Region::parallelogram;
  std::vector<Patch> patches =
      type == "cube"
          ? cube(to_world, flip)
          : std::vector{transformed(to_world, flip, region, Vec3(0.0), Vec3(1, 0, 0), Vec3(0, 1, 0))};
  for (Patch& patch : patches) {
    patch.surface = surface;
    scene.patches.push_back(patch);
  }
  properties.pass_over({"face_normals"});
}

void read_cylinder(Properties& properties, const glm::dmat4& own, const scene::Surface& surface,
                   const ShapeTarget& target) {
  const Vec3 p0 = properties.vector("p0").value_or(Vec3(0.0));
  const Vec3 p1 = properties.vector("p1").value_or(Vec3(0, 0, 1));
  const double radius = properties.real("radius", 1.0);
  if (!(radius > 0.0))
    properties.fail_at("radius", std::to_string(radius) + " is not positive", "a radius above 0");
  if (p0 == p1) properties.fail_at("p1", "it is the same point as p0", "another point");
  MeshRequest request;
  request.file = properties.element().where.text();
  request.warnings = properties.document().warnings;
  request.to_world = own;
  request.instance = target.instance;
  request.flip_normals = properties.boolean("flip_normals", false);
  properties.pass_over({"face_normals"});
  properties.document().note_once(properties.element().where, cylinder_note);
  target.scene.meshes.push_back(
      finish_mesh(cylinder(p0, p1, radius, properties.document().major_version), request));
  target.scene.meshes.back().surface = surface;
}

/// Shapes after which the scene has no more instances: each takes up to a kilobyte.
constexpr std::size_t most_copied = 10'000'000;

/// Reads the shapes of the group once more, transformed by `to_world`.
void read_instance(Properties& properties, const glm::dmat4& to_world, const ShapeTarget& target) {
  const Element* group = properties.object("shape");
  if (target.instance || !group || group->type() != "shapegroup")
    fail(properties.element().where,
         properties.element().name() +
             (target.instance ? " inside a shapegroup" : " without a reference to a shapegroup"),
         "<ref id=\"...\"/> to a <shape type=\"shapegroup\">, which contains no instances");
  const std::size_t shapes = target.scene.patches.size() + target.scene.spheres.size() +
                             facets_of_cylinder * target.scene.meshes.size(); // other meshes are read later
  if (shapes > most_copied)
    fail(properties.element().where,
         "instances are copies, and the scene has more than " + std::to_string(most_copied) + " shapes",
         "fewer instances, or smaller groups");
  Properties of_group(*group, properties.document());
  ShapeTarget inside = target;
  inside.instance = to_world;
  for (const Element* shape : of_group.objects("shape"))
    properties.document().problems->attempt([&] { read_shape(*shape, properties.document(), inside); });
  of_group.finish();
}

} // namespace

void read_shape(const Element& shape, const Document& document, const ShapeTarget& target) {
  const std::string type = shape.type();
  static const std::set<std::string> types{"rectangle", "cube", "disk",       "sphere",   "cylinder",
                                           "obj",       "ply",  "serialized", "instance", "shapegroup"};
  if (!types.contains(type))
    fail(shape.where, shape.name() + " is not supported",
         "supported are " + join({types.begin(), types.end()}));
  if (type == "shapegroup") return; // its instances read it
  Properties properties(shape, document);
  const Attached found = type == "instance" ? Attached() : attached(properties, target);
  const glm::dmat4 own = properties.transform("to_world");
  const glm::dmat4 to_world = target.instance ? *target.instance * own : own;
  if (type == "instance")
    read_instance(properties, to_world, target);
  else if (type == "obj" || type == "ply" || type == "serialized") {
    read_mesh_shape(properties, own, found, target);
  } else if (type == "sphere") {
    target.scene.spheres.push_back(sphere(properties, own, to_world));
    target.scene.spheres.back().surface = found.surface;
  } else if (type == "cylinder") {
    read_cylinder(properties, own, found.surface, target);
  } else {
    read_patches(properties, to_world, found.surface, target.scene);
  }
  properties.finish();
}

} // namespace phlux::scene_file
