// A sphere under a sky of one radiance: what it reflects is known in closed form.
#pragma once

#include "images/scenes.h"

namespace phlux::test {

/// Radiance of the sphere furnace's sky.
inline constexpr Channels sky = {1.0, 0.5, 2.0};

/// Cosine of the angle under which a direction from (0, 0, 4) meets the unit sphere about the origin;
/// negative: it does not.
[[nodiscard]] double cosine_on_sphere(const scene::Vec3& direction);
/// furnace-sphere.xml with a colour for everything, seen from (0, 0, 4). A field of view of 18 degrees holds
/// nothing but the sphere.
[[nodiscard]] scene::Scene sphere_furnace(double fov, int size, const scene::Material& material);
/// Its image by the reflectivity of a diffuse or phong material.
[[nodiscard]] Estimate sphere_reference(const scene::Scene& scene, const scene::Material& material);

} // namespace phlux::test
