// A scene with all transforms applied, in double precision and world units. Independent of file formats,
// devices and integrators.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
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
  /// Texture coordinates of a parallelogram at its origin, and what they change by along edge_u and edge_v.
  /// For an ellipse these are coordinates whose polar ones, (radius, turns), are its texture coordinates.
  std::array<glm::dvec2, 3> uv{glm::dvec2(0.5), glm::dvec2(0.5, 0), glm::dvec2(0, 0.5)};
};

struct Sphere {
  Vec3 center{0.0};
  double radius = 1.0;          ///< > 0
  bool front_is_inside = false; ///< flipNormals
  Surface surface;
  /// Unit vectors along which the object's x, y and z axes lie. Texture coordinates are the longitude about
  /// z, from x, in turns, and the angle from z over pi.
  std::array<Vec3, 3> axes{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
};

/// Triangles that share vertices. The front side is counter-clockwise (along cross(p1 - p0, p2 - p0)); the
/// loader has already reversed triangles and normals for flipNormals, and dropped triangles without area.
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<glm::vec3> normals; ///< one per position, unit but in transformed instances; empty: flat
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Surface surface;
  /// One per position. Empty: the second and third barycentric coordinates of each triangle, as in Mitsuba;
  /// meshes whose material needs none are loaded without.
  std::vector<glm::vec2> texture_coordinates = {};
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

/// Radiance from infinity. Texels are stored row by row from the pole at +y of the map's frame; column
/// (phi / 2 pi) width, row (theta / pi) height lies towards (sin theta sin phi, cos theta, -sin theta cos
/// phi), as in Mitsuba. Between their centres the radiance is bilinear.
struct EnvironmentMap {
  int width = 0, height = 0;
  std::vector<glm::vec3> texels; ///< finite and not negative
  glm::dmat3 to_world{1.0};      ///< orthonormal
  Rgb scale{1.0};                ///< of the texels
};

/// A reconstruction filter whose sizes are in pixels.
struct Filter {
  enum class Kind { box, tent, gaussian };
  Kind kind = Kind::box;
  double size = 0.5; ///< box: 0.5; tent: its radius; gaussian: its standard deviation
};

/// A pinhole camera, a thin lens or an orthographic camera. In its own frame it looks along +z, +y is up and,
/// as in Mitsuba, +x points to the left of the image.
struct Camera {
  bool orthographic = false; ///< rays are parallel, and start on the film about `position`
  Vec3 position{0.0}, left{1, 0, 0}, up{0, 1, 0},
      forward{0, 0, 1}; ///< orthonormal; right-handed unless toWorld mirrors
  double tan_half_fov_x =
      1.0; ///< tangent of half the horizontal field of view; orthographic: half the film's width
  double principal_x = 0.0,
         principal_y = 0.0;     ///< Mitsuba's principalPointOffset, in units of the film's size
  double aperture_radius = 0.0; ///< of the lens; 0: a pinhole
  double focus_distance = 1.0;  ///< from the lens to the plane in focus
  Filter filter;
  int width = 768, height = 576; ///< pixels, square
  /// Of a part of an image (crop_image): the place of its upper left pixel, and the size of the whole; 0: it
  /// is whole.
  std::array<int, 2> origin{}, whole{};
};

/// A part of an image, in pixels; x and y are of its upper left pixel.
struct Window {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Window&) const = default;
};

/// Settings of the scene file; the command line overrides them.
struct RenderDefaults {
  std::string integrator = "path"; ///< path, light or bidir
  int samples_per_pixel = 4;
  int max_depth = -1;         ///< largest number of edges of a path, -1: unbounded; 1 is emission alone
  int rr_depth = 5;           ///< number of edges from which roulette may end a path, -1: never
  std::optional<Window> crop; ///< the part of the image to render
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
  std::optional<Rgb> constant_radiance;      ///< the `constant` emitter
  std::optional<EnvironmentMap> environment; ///< excludes constant_radiance
  /// Mitsuba's strictNormals: directions that lie on different sides of the interpolated and the geometric
  /// normal carry no light. Otherwise the interpolated normal alone decides on the side.
  bool strict_normals = false;
  bool hide_emitters =
      false; ///< Mitsuba's hideEmitters: the camera sees no light itself, only what it lights
  Camera camera;
  RenderDefaults defaults;
  std::vector<std::filesystem::path> files; ///< that were read: the scene file, meshes, textures
};

/// Whether the reflection depends on the surface's texture coordinates or tangents.
[[nodiscard]] inline bool needs_uv(const Material& material) {
  return material.is_textured() || material.model->needs_tangents;
}
[[nodiscard]] inline bool needs_uv(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& m) { return needs_uv(m); });
}

/// Whether anything emits, be it with a power of zero.
[[nodiscard]] inline bool has_lights(const Scene& scene) {
  return !scene.area_emitters.empty() || !scene.point_lights.empty() || !scene.spot_lights.empty() ||
         !scene.directional_lights.empty() || scene.constant_radiance || scene.environment;
}

/// Whether some surfaces scatter by delta distributions: mirrors and smooth glass.
[[nodiscard]] inline bool has_delta(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& m) { return m.model->has_delta; });
}

} // namespace phlux::scene
