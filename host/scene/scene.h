// A scene with all transforms applied, in double precision and world units. Independent of file formats,
// devices and integrators.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "scene/model.h"

namespace phlux::scene {

using Vec3 = glm::dvec3;

/// A shape's indices into Scene::materials and Scene::area_emitters (-1: emits nothing).
struct Surface {
  int material = 0;
  int area_emitter = -1;
};

/// A flat shape {origin + u edge_u + v edge_v}, front side along cross(edge_u, edge_v).
/// parallelogram: |u| <= 1, |v| <= 1 (origin is the centre); ellipse: u^2 + v^2 <= 1 (origin is the centre).
struct Patch {
  enum class Region { parallelogram, ellipse };
  Region region = Region::parallelogram;
  Vec3 origin{0.0}, edge_u{1, 0, 0}, edge_v{0, 1, 0};
  Surface surface;
};

struct Sphere {
  Vec3 center{0.0};
  double radius = 1.0;          ///< > 0
  bool front_is_inside = false; ///< flipNormals
  Surface surface;
};

/// Triangles that share vertices. The front side is counter-clockwise (along cross(p1 - p0, p2 - p0)); the
/// loader has already reversed triangles and normals for flipNormals, and dropped triangles without area.
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<glm::vec3> normals; ///< unit, one per position; empty: flat shading
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Surface surface;
};

struct AreaEmitter { ///< radiance leaves the front side of the shape that refers to it
  Rgb radiance{1.0}; ///< W / (m^2 sr)
};

struct PointLight {
  Vec3 position{0.0};
  Rgb intensity{1.0}; ///< W / sr
};

/// As Mitsuba's `spot`: intensity is constant within the angle beam_width of the axis and falls linearly in
/// the angle to 0 at cutoff_angle, both in radians from the axis, 0 <= beam_width <= cutoff_angle <= pi.
struct SpotLight {
  Vec3 position{0.0}, direction{0, 0, 1}; ///< direction: unit, the axis along which light travels
  Rgb intensity{1.0};
  double cutoff_angle = 0.0, beam_width = 0.0;
};

struct DirectionalLight {
  Vec3 direction{0, 0, 1}; ///< unit, along which light travels
  Rgb irradiance{1.0};     ///< W / m^2 on a surface facing the light
};

/// A pinhole camera. In its own frame it looks along +z, +y is up and, as in Mitsuba, +x points to the left
/// of the image.
struct Camera {
  Vec3 position{0.0}, left{1, 0, 0}, up{0, 1, 0},
      forward{0, 0, 1};        ///< orthonormal; right-handed unless toWorld mirrors
  double tan_half_fov_x = 1.0; ///< tangent of half the horizontal field of view
  double principal_x = 0.0,
         principal_y = 0.0;      ///< Mitsuba's principalPointOffset, in units of the film's size
  int width = 768, height = 576; ///< pixels, square
};

/// Settings of the scene file; the command line overrides them.
struct RenderDefaults {
  std::string integrator = "path"; ///< path, light or bidir
  int samples_per_pixel = 4;
  int max_depth = -1; ///< largest number of edges of a path, -1: unbounded; 1 is emission alone
  int rr_depth = 5;   ///< number of edges from which roulette may end a path, -1: never
};

struct Scene {
  std::vector<Material> materials;
  std::vector<AreaEmitter> area_emitters;
  std::vector<Patch> patches;
  std::vector<Sphere> spheres;
  std::vector<Mesh> meshes;
  std::vector<PointLight> point_lights;
  std::vector<SpotLight> spot_lights;
  std::vector<DirectionalLight> directional_lights;
  std::optional<Rgb> constant_radiance; ///< the `constant` emitter
  /// Mitsuba's strictNormals: directions that lie on different sides of the interpolated and the geometric
  /// normal carry no light. Otherwise the interpolated normal alone decides on the side.
  bool strict_normals = false;
  Camera camera;
  RenderDefaults defaults;
};

} // namespace phlux::scene
