// Small meshes of random shape as OBJ and PLY files.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "random/random_numbers.h"
#include "scene/scene.h"

namespace phlux::test {

struct RandomMesh {
  std::vector<scene::Vec3> positions, normals; ///< a normal per position, or none
  std::vector<std::array<int, 3>> triangles;
};

enum class MeshShape { tetrahedron, octahedron, icosahedron, sheet };

/// Meshes about as large as the unit sphere, closed except for the sheet. `random` moves the vertices, never
/// so far that a closed mesh turns inside out; normals deviate from those of the triangles by about twenty
/// degrees.
[[nodiscard]] RandomMesh random_mesh(MeshShape shape, bool with_normals, RandomNumbers& random);
/// A box of half edge 1 seen from inside, with inclined normals, so that errors in their treatment do not
/// average out.
[[nodiscard]] RandomMesh random_room(RandomNumbers& random);

[[nodiscard]] std::string obj_file(const RandomMesh& mesh);

enum class PlyFormat { ascii, little_endian, big_endian };
[[nodiscard]] std::string ply_file(const RandomMesh& mesh, PlyFormat format);

} // namespace phlux::test
