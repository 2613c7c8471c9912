// Scenes for the tests of rendering, shipped or built here, and their renders.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "images/agreement.h"
#include "lobes/models.h"
#include "render/render.h"
#include "scene/scene.h"

namespace phlux::test {

/// Names of the scenes in scenes/, without ".xml".
[[nodiscard]] const std::vector<std::string>& shipped_names();
[[nodiscard]] scene::Scene shipped(const std::string& name, int width, int height);
/// A scene from Mitsuba's XML.
[[nodiscard]] scene::Scene from_xml(const std::string& text);

[[nodiscard]] scene::Camera look_at(const scene::Vec3& origin, const scene::Vec3& target, double fov_degrees,
                                    int width, int height);
/// Unit direction through (x, y) in pixels from the image's upper left corner.
[[nodiscard]] scene::Vec3 direction_through(const scene::Camera& camera, double x, double y);
/// Means over the pixels' areas of the radiance in a direction from the camera, by the midpoint rule with
/// `points` x `points` points a pixel.
[[nodiscard]] Estimate expected(const scene::Camera& camera,
                                const std::function<Channels(const scene::Vec3& direction)>& radiance,
                                int points = 32);

using lobes::diffuse;
using lobes::phong;

/// A square of half side `half` about `center`, spanned by the unit vectors edge_u and edge_v; their cross
/// product is the normal of its front.
[[nodiscard]] scene::Patch square(const scene::Vec3& center, const scene::Vec3& edge_u,
                                  const scene::Vec3& edge_v, double half, scene::Surface surface);

/// An octahedron with the interpolated normals of a sphere, its front outside.
[[nodiscard]] scene::Mesh smooth_ball(const scene::Vec3& center, double radius, int material);

/// Scales everything about the world's origin and then moves it; lights keep the irradiance of surfaces.
[[nodiscard]] scene::Scene placed(scene::Scene scene, double scale, const scene::Vec3& offset);

/// Whether all pixels are black.
[[nodiscard]] bool is_black(const film::Film& film);

struct Render {
  film::Film film;
  render::Statistics statistics;
};

/// Settings with `samples` samples per pixel, the tested kernels (tested_kernels.h) and this depth of paths
/// (-1: unbounded).
[[nodiscard]] render::Settings settings_for(int samples, int max_depth = -1);
[[nodiscard]] Render render_of(const scene::Scene& scene, const render::Settings& settings);

} // namespace phlux::test
