// Mesh files to meshes in world space.
#pragma once

#include <filesystem>

#include <glm/mat4x4.hpp>

#include "scene/scene.h"
#include "scene_file/location.h"

namespace phlux::scene_file {

struct MeshRequest {
  std::filesystem::path file;
  Location named_at; ///< where the scene names the file
  glm::dmat4 to_world{1.0};
  bool flip_normals = false;
  bool face_normals = false; ///< flat shading, whatever normals the file has
};

/// Wavefront OBJ: v, vn and f of the whole file as one mesh; groups and materials are passed over.
/// @throws SceneError "FILE:LINE: ..." of the mesh file
[[nodiscard]] scene::Mesh load_obj(const MeshRequest& request);

/// Stanford PLY 1.0: ascii, binary_little_endian and binary_big_endian.
/// @throws SceneError naming the mesh file, and the line (ascii) or the row (binary)
[[nodiscard]] scene::Mesh load_ply(const MeshRequest& request);

/// The file's bytes. @throws SceneError at request.named_at if it cannot be read
[[nodiscard]] std::string read_bytes(const MeshRequest& request);

/// A mesh as its file has it (object space; a zero normal is one that the file does not give) to what scene.h
/// promises. Triangles without area are dropped with a warning that counts them, together with `dropped`
/// others. As in Mitsuba, normals that the file does not give are computed (weighted by angle), unless
/// face_normals is set; and where the file has normals they, not the order of the vertices, say which side of
/// a triangle is its front.
/// @throws SceneError if the transform takes a vertex out of single precision's range
[[nodiscard]] scene::Mesh finish_mesh(scene::Mesh mesh, const MeshRequest& request, std::size_t dropped);

} // namespace phlux::scene_file
