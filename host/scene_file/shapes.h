// <shape>: rectangle, cube, disk and sphere in closed form; obj and ply as meshes.
#pragma once

#include "scene/scene.h"
#include "scene_file/document.h"
#include "scene_file/materials.h"

namespace phlux::scene_file {

/// Adds the shape, its material and its emitter to the scene, in world space.
///
/// Front sides: `to_world` takes the front side of the object to the front side in the world, also where it
/// mirrors (normals go with the inverse transpose), and flip_normals turns it over. So do all of Mitsuba's
/// shapes, except that 0.6 turns mirrored meshes without vertex normals inside out, which Mitsuba 3 mended.
/// @throws SceneError
void read_shape(const Element& shape, const Document& document, MaterialRules rules, scene::Scene& scene);

} // namespace phlux::scene_file
