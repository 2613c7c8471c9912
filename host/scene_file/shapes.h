// <shape>: rectangle, cube, disk and sphere in closed form; obj and ply as meshes.
#pragma once

#include "scene/scene.h"
#include "scene_file/document.h"
#include "scene_file/materials.h"

namespace phlux::scene_file {

/// Adds the shape, its material and its emitter to the scene, in world space.
///
/// `to_world` transforms the object's front side to the front side in the world, even if it mirrors (normals
/// are transformed by the inverse transpose); flip_normals exchanges the sides. So does Mitsuba, except that
/// 0.6 turns mirrored meshes without vertex normals inside out, which Mitsuba 3 corrected.
/// @throws SceneError
void read_shape(const Element& shape, const Document& document, MaterialRules rules, scene::Scene& scene);

} // namespace phlux::scene_file
