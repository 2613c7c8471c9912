// <integrator>: Mitsuba's methods by the three integrators.
#pragma once

#include "scene/scene.h"
#include "scene_file/document.h"

namespace phlux::scene_file {

/// The scene's integrator, max_depth, rr_depth and strict_normals. Methods of Mitsuba that compute the same
/// radiance in another way become path or bidir, with a note. @throws SceneError
void read_integrator(const Element& integrator, const Document& document, scene::Scene& scene);

} // namespace phlux::scene_file
