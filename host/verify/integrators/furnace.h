// Closed rooms whose radiance is known: all surfaces emit radiance 1 and, but for one, reflect alike.
#pragma once

#include "scene/scene.h"

namespace phlux::verify {

using scene::Rgb;

/// A room of albedo a inside a sphere, with a ball and a cube in it, on each of which lights are sampled, and
/// hit. What paths of e edges carry is a^(e - 1) at every point and in every direction.
///
/// Surfaces that see each other and are not of the enclosing sphere are apart, and inside a sphere the
/// geometry term cos cos / distance^2 of a connection is constant: it is bounded, and every technique has a
/// finite variance.
[[nodiscard]] scene::Scene furnace();
/// The radiance along paths of this many edges.
[[nodiscard]] Rgb furnace_radiance(int edges);
/// That along paths of up to so many edges, 1 + a + a^2 + ...; -1: of any number, 1 / (1 - a).
[[nodiscard]] Rgb furnace_radiance_up_to(int edges);

/// The same room, seen towards the ball, which has a Phong lobe and fills the image. Paths of up to three
/// edges carry 1 + rho (1 + a), where rho is the ball's reflectivity: it is lit by 1 and, after a reflection,
/// by a from everywhere.
[[nodiscard]] scene::Scene glossy_furnace();
inline constexpr int glossy_edges = 3;
/// The mean of that over the image.
[[nodiscard]] Rgb glossy_furnace_radiance();

} // namespace phlux::verify
