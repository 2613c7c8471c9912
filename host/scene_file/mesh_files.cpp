#include "scene_file/mesh_files.h"

#include <memory>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "scene_file/materials.h"
#include "scene_file/obj_materials.h"
#include "scene_file/problems.h"

namespace phlux::scene_file {

namespace {

/// About what a triangle takes on host and device together, with its share of vertices and of the hierarchy.
constexpr std::uint64_t bytes_per_triangle = 300;
/// Triangles that instances may add.
constexpr std::uint64_t most_copied = 100'000'000;

/// Shapes with equal keys read the same parts.
auto key_of(const MeshRequest& request) {
  return std::tuple(request.file, request.shape_index, request.face_normals, request.parts,
                    request.separate_groups, request.texture_coordinates, request.flip_tex_coords);
}

MeshFile read_file(const MeshRequest& request) {
  if (request.format == "obj") return load_obj(request);
  return request.format == "ply" ? load_ply(request) : load_serialized(request);
}

/// Of a mesh without texture coordinates whose material looks different for others.
void warn_without_uv(const scene::Material& material, const MeshRequest& request) {
  const bool anisotropic = material.model == lobes::shipped("anisotropicphong")
                               ? material.value("exponent_u") != material.value("exponent_v")
                               : material.model->needs_tangents;
  if (material.is_textured() || anisotropic)
    request.warnings->add(
        request.named_at,
        "the mesh has no texture coordinates: as in Mitsuba, a texture is on each triangle by "
        "itself, and an anisotropic lobe has arbitrary axes: add vt (obj) or u, v (ply)");
}

class Loader {
public:
  Loader(const std::vector<MeshShape>& shapes, scene::Scene& scene)
      : scene_(scene), materials_(scene.materials) {
    for (const MeshShape& shape : shapes) ++users_[key_of(shape.request)];
  }

  void load(const MeshShape& shape) {
    const MeshFile& file = read(shape.request);
    add_library(shape, file);
    for (std::size_t i = 0; i < file.parts.size(); ++i) {
      const bool is_wanted = shape.request.format != "obj" || shape.request.shape_index < 0 ||
                             static_cast<std::size_t>(shape.request.shape_index) == i;
      if (is_wanted) add_part(shape, file.parts[i]);
    }
    if (shape.request.format == "obj" && shape.request.shape_index >= static_cast<int>(file.parts.size()))
      fail(shape.request.named_at, "the file has no part " + std::to_string(shape.request.shape_index),
           "a shape index from 0 to " + std::to_string(file.parts.size() - 1));
    if (--users_[key_of(shape.request)] == 0) files_.erase(key_of(shape.request));
  }

  void note_copies(const Location& where) const {
    if (copied_ > 0)
      note(where, fmt::format("instances are copies: {} triangles, about {} MB", copied_,
                              copied_ * bytes_per_triangle / 1'000'000));
  }

private:
  using Key = decltype(key_of(std::declval<MeshRequest>()));

  const MeshFile& read(const MeshRequest& request) {
    const auto found = files_.find(key_of(request));
    return found != files_.end() ? found->second
                                 : files_.emplace(key_of(request), read_file(request)).first->second;
  }

  /// Reads the file's materials if a part needs them.
  void add_library(const MeshShape& shape, const MeshFile& file) {
    const auto folder = shape.request.file.parent_path();
    if (!file.material_library.empty() && !shape.library_materials)
      note(shape.request.named_at, "the materials of the OBJ file are not used: the shape's bsdf is");
    if (file.material_library.empty() || !shape.library_materials || libraries_.contains(shape.request.file))
      return;
    auto& library = libraries_[shape.request.file];
    scene_.files.push_back(folder / file.material_library);
    for (const auto& [name, material] :
         read_obj_materials(folder / file.material_library, shape.request.named_at, *shape.request.warnings))
      library[name] = materials_.index_of(material);
  }

  [[nodiscard]] scene::Surface surface_of(const MeshShape& shape, const MeshPart& part) const {
    scene::Surface surface = shape.surface;
    const auto named = shape.materials.find(part.material);
    if (named != shape.materials.end()) {
      surface.material = named->second;
    } else if (shape.library_materials && libraries_.contains(shape.request.file)) {
      const auto& library = libraries_.at(shape.request.file);
      const auto material = library.find(part.material);
      if (material != library.end()) surface.material = material->second;
    }
    return surface;
  }

  void add_part(const MeshShape& shape, const MeshPart& part) {
    if (shape.request.instance) copied_ += part.mesh.triangles.size();
    if (copied_ > most_copied)
      fail(shape.request.named_at,
           fmt::format("instances are copies, here of more than {} triangles ({} GB)", most_copied,
                       most_copied * bytes_per_triangle / 1'000'000'000),
           "fewer instances or smaller meshes");
    scene::Mesh mesh = finish_mesh(part, shape.request);
    mesh.surface = surface_of(shape, part);
    if (mesh.texture_coordinates.empty())
      warn_without_uv(scene_.materials[static_cast<std::size_t>(mesh.surface.material)], shape.request);
    if (!mesh.triangles.empty()) scene_.meshes.push_back(std::move(mesh));
  }

  scene::Scene& scene_;
  SharedMaterials materials_;
  std::map<Key, int> users_; ///< shapes that still have to read a file
  std::map<Key, MeshFile> files_;
  std::map<std::filesystem::path, std::map<std::string, int>> libraries_; ///< of obj files: material by name
  std::uint64_t copied_ = 0;
};

} // namespace

void MeshFiles::load(scene::Scene& scene, Problems& problems) {
  Loader loader(shapes_, scene);
  for (const MeshShape& shape : shapes_) problems.attempt([&] { loader.load(shape); });
  if (!shapes_.empty()) loader.note_copies(shapes_.front().request.named_at);
}

} // namespace phlux::scene_file
