#include "scene_file/shapes.h"

#include <array>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "scene_file/emitters.h"
#include "scene_file/mesh.h"
#include "scene_file/properties.h"
#include "scene_file/transform.h"

namespace phlux::scene_file {

namespace {

using scene::Patch;
using scene::Vec3;

bool mirrors(const glm::dmat4& matrix) {
  return glm::determinant(glm::dmat3(matrix)) < 0.0;
}

/// Transforms a patch, with front side along cross(u, v), from the object to the world.
Patch transformed(const glm::dmat4& to_world, bool flip, Patch::Region region, const Vec3& origin,
                  const Vec3& u, const Vec3& v) {
  const glm::dmat3 linear(to_world);
  Patch patch{region, Vec3(to_world * glm::dvec4(origin, 1.0)), linear * u, linear * v, {}};
  // cross(M u, M v) = det(M) M^-T cross(u, v) points to the back if M mirrors.
  if (mirrors(to_world) != flip)
    patch.edge_v = -patch.edge_v; // both regions are symmetric; edge_u stays the tangent
  return patch;
}

/// The faces of [-1, 1]^3, with the front outside: a face's origin is the cross product of its edges.
std::vector<Patch> cube(const glm::dmat4& to_world, bool flip) {
  std::vector<Patch> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3 normal(0.0), u(0.0), v(0.0);
      normal[axis] = side;
      u[(axis + 1) % 3] = 1.0;
      v[(axis + 2) % 3] = side;
      faces.push_back(transformed(to_world, flip, Patch::Region::parallelogram, normal, u, v));
    }
  return faces;
}

scene::Sphere sphere(Properties& properties, const glm::dmat4& to_world) {
  scene::Sphere result;
  Vec3 center = properties.vector("center").value_or(Vec3(0.0));
  const double radius = properties.real("radius", 1.0);
  if (!(radius > 0.0))
    properties.fail_at("radius", std::to_string(radius) + " is not positive", "a radius above 0");
  if (!is_similarity(to_world))
    properties.fail_at("to_world", "it would turn the sphere into an ellipsoid",
                       "a uniform scale, rotations, translations");
  const double scale = glm::length(Vec3(to_world[0]));
  if (properties.document().major_version == 0) center /= scale; // 0.x scales the radius but not the centre
  result.center = Vec3(to_world * glm::dvec4(center, 1.0));
  result.radius = radius * scale;
  result.front_is_inside = properties.boolean("flip_normals", false);
  return result;
}

scene::Surface surface(Properties& properties, MaterialRules rules, scene::Scene& scene) {
  const Document& document = properties.document();
  const Element* bsdf = properties.object("bsdf");
  const Element* emitter = properties.object("emitter");
  // Mitsuba's default is grey 0.5, or black if the shape emits.
  const scene::Material material =
      bsdf ? read_material(*bsdf, document, rules) : lobes::diffuse(scene::Rgb(emitter ? 0.0 : 0.5));
  scene::Surface result{share(scene.materials, material), -1};
  if (!emitter) return result;
  const scene::AreaEmitter area = read_area_emitter(*emitter, document);
  if (area.radiance == scene::Rgb(0.0)) return result;
  result.area_emitter = static_cast<int>(scene.area_emitters.size());
  scene.area_emitters.push_back(area);
  return result;
}

void read_mesh_shape(Properties& properties, const glm::dmat4& to_world, const scene::Surface& surface,
                     scene::Scene& scene) {
  properties.pass_over({"collapse", "flip_tex_coords", "load_materials", "srgb"});
  if (properties.integer("shape_index", -1) >= 0)
    properties.fail_at("shape_index", "parts of files are not supported",
                       "leave it out: the whole file is one mesh");
  if (properties.string("filename", "").empty())
    fail(properties.element().where, properties.element().name() + " without a filename",
         "<string name=\"filename\" .../>");
  MeshRequest request;
  request.file = properties.document().path_of(properties.string("filename", ""));
  request.named_at = properties.where("filename");
  request.to_world = to_world;
  request.flip_normals = properties.boolean("flip_normals", false);
  request.face_normals = properties.boolean("face_normals", false);
  scene::Mesh mesh = properties.element().type() == "obj" ? load_obj(request) : load_ply(request);
  mesh.surface = surface;
  if (!mesh.triangles.empty()) scene.meshes.push_back(std::move(mesh));
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

} // namespace

void read_shape(const Element& shape, const Document& document, MaterialRules rules, scene::Scene& scene) {
  const std::string type = shape.type();
  static const std::set<std::string> types{"rectangle", "cube", "disk", "sphere", "obj", "ply"};
  if (!types.contains(type))
    fail(shape.where, shape.name() + " is not supported",
         "supported are rectangle, cube, disk, sphere, obj, ply");
  Properties properties(shape, document);
  const glm::dmat4 to_world = properties.transform("to_world");
  const scene::Surface attached = surface(properties, rules, scene);
  if (type == "obj" || type == "ply") {
    read_mesh_shape(properties, to_world, attached, scene);
  } else if (type == "sphere") {
    scene.spheres.push_back(sphere(properties, to_world));
    scene.spheres.back().surface = attached;
  } else {
    read_patches(properties, to_world, attached, scene);
  }
  properties.finish();
}

} // namespace phlux::scene_file
