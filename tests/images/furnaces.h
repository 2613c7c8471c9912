// A sphere under a sky of constant radiance: its reflected radiance is known in closed form.
#pragma once

#include "images/scenes.h"

namespace phlux::test {

/// Radiance of the sky.
inline constexpr Channels sky = {1.0, 0.5, 2.0};

/// Cosine of the angle of incidence of a ray from (0, 0, 4) on the unit sphere about the origin; negative if
/// it misses.
[[nodiscard]] double cosine_on_sphere(const scene::Vec3& direction);
/// furnace-sphere.xml with coloured material and sky, seen from (0, 0, 4). The sphere fills a field of view
/// of 18 degrees.
[[nodiscard]] scene::Scene sphere_furnace(double fov, int size, const scene::Material& material);
/// Its exact image, from the reflectivity of a diffuse or phong material.
[[nodiscard]] Estimate sphere_reference(const scene::Scene& scene, const scene::Material& material);

} // namespace phlux::test
