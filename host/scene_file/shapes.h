// <shape>: rectangle, cube, disk and sphere in closed form; obj, ply and serialized files and the cylinder as
// meshes; instances as copies.
#pragma once

#include <map>
#include <optional>

#include <glm/mat4x4.hpp>

#include "scene/scene.h"
#include "scene_file/document.h"
#include "scene_file/materials.h"
#include "scene_file/mesh_files.h"

namespace phlux::scene_file {

/// Where shapes go.
struct ShapeTarget {
  const MaterialRules& rules;
  scene::Scene& scene;
  MeshFiles& meshes;
  std::map<const Element*, int>& materials; ///< by <bsdf>: indices into scene.materials of those read before
  SharedMaterials& shared;                  ///< scene.materials
  std::optional<glm::dmat4> instance = {};  ///< transform of the instance whose group is read
};

/// Adds the shape, its material and its emitter to the scene, in world space; shapes whose geometry is in a
/// file to target.meshes.
///
/// `to_world` transforms the object's front side to the front side in the world, even if it mirrors (normals
/// are transformed by the inverse transpose); flip_normals exchanges the sides. So does Mitsuba, except that
/// 0.6 turns mirrored meshes without vertex normals inside out, which Mitsuba 3 corrected.
/// @throws SceneError
void read_shape(const Element& shape, const Document& document, const ShapeTarget& target);

} // namespace phlux::scene_file
