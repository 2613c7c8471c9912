// <shape type="cylinder"> as a mesh with smooth normals.
#pragma once

#include "scene_file/mesh.h"

namespace phlux::scene_file {

/// What is approximated, for messages.
inline constexpr const char* cylinder_note =
    "cylinders are meshes of 256 facets with smooth normals and the exact area: within 6e-5 of the radius";

inline constexpr std::uint32_t facets_of_cylinder = 256;

/// The open cylinder around the line from p0 to p1, normals outwards, in object space. Its facets have the
/// area of the cylinder, so that an emitter has the exact power; points are off by at most 6e-5 radii. Its
/// texture begins where it does in Mitsuba of this version.
[[nodiscard]] MeshPart cylinder(const scene::Vec3& p0, const scene::Vec3& p1, double radius,
                                int major_version);

} // namespace phlux::scene_file
