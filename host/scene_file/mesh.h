// Reads mesh files into meshes in world space.
#pragma once

#include <filesystem>

#include <glm/mat4x4.hpp>

#include "scene/scene.h"
#include "scene_file/location.h"

namespace phlux::scene_file {

struct MeshRequest {
  std::filesystem::path file;
  Location named_at; ///< of the file's name in the scene
  glm::dmat4 to_world{1.0};
  bool flip_normals = false;
  bool face_normals = false; ///< flat shading; the file's normals are ignored
};

/// Wavefront OBJ: v, vn and f of the whole file as one mesh; groups and materials are ignored.
/// Time is linear in the file's size, and memory at most 40 times it.
/// @throws SceneError "FILE:LINE: ..." of the mesh file
[[nodiscard]] scene::Mesh load_obj(const MeshRequest& request);

/// Stanford PLY 1.0: ascii, binary_little_endian and binary_big_endian.
/// Time is linear in the file's size, and memory at most 40 times it.
/// @throws SceneError with the mesh file and the line (ascii) or row (binary)
[[nodiscard]] scene::Mesh load_ply(const MeshRequest& request);

/// The file's bytes, without a byte order mark. @throws SceneError at request.named_at if it cannot be read
[[nodiscard]] std::string read_bytes(const MeshRequest& request);

/// Transforms a file's mesh (object space, with zero for missing normals) to a mesh as in scene.h. Triangles
/// without area are dropped with a warning that counts them; another counts the `incomplete` faces that the
/// reader has dropped. As in Mitsuba, missing normals are computed (weighted by angle), unless face_normals
/// is set; and a triangle's front side follows the file's normals or, without them, the order of its
/// transformed vertices.
/// @throws SceneError if a transformed vertex is outside single precision's range
[[nodiscard]] scene::Mesh finish_mesh(scene::Mesh mesh, const MeshRequest& request, std::size_t incomplete);

} // namespace phlux::scene_file
