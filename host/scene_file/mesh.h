// Reads mesh files into meshes in world space.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "scene/scene.h"
#include "scene_file/location.h"
#include "scene_file/warnings.h"

namespace phlux::scene_file {

/// Into how many meshes an obj file is read.
enum class ObjParts {
  one,                  ///< groups and materials are ignored
  by_library_materials, ///< one for each run of faces with a `usemtl`, if the file names a library of
                        ///< materials
  by_materials,         ///< the same with or without library
  by_groups             ///< `g` begins a mesh as well: those that shapeIndex of Mitsuba 0.6 counts
};

struct MeshRequest {
  std::string format; ///< obj, ply or serialized
  std::filesystem::path file;
  Location named_at;        ///< of the file's name in the scene
  glm::dmat4 to_world{1.0}; ///< the shape's own
  std::optional<glm::dmat4>
      instance; ///< transform of the instance that the mesh belongs to, applied after it
  bool flip_normals = false;
  bool face_normals = false;        ///< flat shading; the file's normals are ignored
  bool texture_coordinates = false; ///< reads them
  bool flip_tex_coords = false;     ///< v becomes 1 - v
  int shape_index = -1; ///< the part of the file: of serialized files, -1: the first; of obj files, -1: all
  ObjParts parts = ObjParts::one;
  /// obj: groups and materials share no vertices, so that computed normals are not smooth across their
  /// borders.
  bool separate_groups = false;
  std::shared_ptr<Warnings> warnings = std::make_shared<Warnings>(); ///< of the scene
};

/// A mesh of a file, in object space, with zero for missing normals.
struct MeshPart {
  scene::Mesh mesh;
  std::string material;       ///< obj: the name that `usemtl` gave; or empty
  std::size_t incomplete = 0; ///< faces with fewer than three corners, which are left out
  bool face_normals = false;
};

/// What a file holds.
struct MeshFile {
  std::vector<MeshPart> parts;
  std::string material_library; ///< obj: the name that `mtllib` gave; or empty
};

/// Wavefront OBJ: v, vn and f. Parts share no vertices, as in Mitsuba 0.6.
/// Time is linear in the file's size, and memory at most 40 times it.
/// @throws SceneError "FILE:LINE: ..." of the mesh file
[[nodiscard]] MeshFile load_obj(const MeshRequest& request);

/// Stanford PLY 1.0: ascii, binary_little_endian and binary_big_endian.
/// Time is linear in the file's size, and memory at most 40 times it.
/// @throws SceneError with the mesh file and the line (ascii) or row (binary)
[[nodiscard]] MeshFile load_ply(const MeshRequest& request);

/// A mesh of a file of Mitsuba's binary format, versions 3 and 4.
/// @throws SceneError with the mesh file
[[nodiscard]] MeshFile load_serialized(const MeshRequest& request);

/// The file's bytes, without a byte order mark. @throws SceneError at request.named_at if it cannot be read
[[nodiscard]] std::string read_bytes(const MeshRequest& request);

/// Transforms a part to a mesh as in scene.h. Triangles without area are dropped with a warning that counts
/// them; another counts part.incomplete. As in Mitsuba, missing normals are computed (weighted by angle),
/// unless face_normals is set; and a triangle's front side follows the file's normals or, without them, the
/// order of its transformed vertices. An instance transforms the result: its front sides even if it mirrors,
/// and its interpolated normals, which keep the lengths that the inverse transpose gives them (the longest is
/// 1).
/// @throws SceneError if a transformed vertex is outside single precision's range
[[nodiscard]] scene::Mesh finish_mesh(MeshPart part, const MeshRequest& request);

} // namespace phlux::scene_file
