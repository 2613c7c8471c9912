#include "tables/host_scene.h"

#include <glm/geometric.hpp>

#include "errors.h"
#include "tables/used_materials.h"

namespace phlux::tables {
namespace {

// The number of primitives up to which testing each in turn is as fast as a hierarchy, measured on bounce
// rays in a closed room (bench/PERFORMANCE.md).
std::uint64_t brute_force_limit(int lanes) {
  switch (lanes) {
  case 1:
    return 32;
  case 4:
    return 128;
  case 8:
    return 160;
  default:
    return 240;
  }
}

CameraRecord camera_record(const scene::Camera& camera, const scene::Vec3& origin) {
  CameraRecord record{};
  const scene::Vec3 position = camera.position - origin;
  const scene::Vec3 left = camera.left * camera.tan_half_fov_x;
  const scene::Vec3 up = camera.up * (camera.tan_half_fov_x * camera.height / camera.width);
  for (int i = 0; i < 3; ++i) {
    record.position[i] = static_cast<float>(position[i]);
    record.forward[i] = static_cast<float>(camera.forward[i]);
    record.left[i] = static_cast<float>(left[i]);
    record.up[i] = static_cast<float>(up[i]);
  }
  record.principal_x = static_cast<float>(camera.principal_x);
  record.principal_y = static_cast<float>(camera.principal_y);
  record.film_area = static_cast<float>(4 * glm::length(left) * glm::length(up));
  record.lens[0] = static_cast<float>(camera.aperture_radius / glm::length(left));
  record.lens[1] = static_cast<float>(camera.aperture_radius / glm::length(up));
  record.inv_focus_distance = static_cast<float>(1 / camera.focus_distance);
  record.filter_size = static_cast<float>(camera.filter.size);
  record.width = camera.width;
  record.height = camera.height;
  return record;
}

} // namespace

HostScene prepare(const scene::Scene& scene, const settings::Settings& settings, int lanes,
                  KnownGeometry* known) {
  const std::uint64_t primitives = accel::count_primitives(scene);
  if (primitives == 0) throw SceneError("the scene has no shapes: add at least one that the camera can see");
  using settings::Traversal;
  const bool brute = settings.traversal == Traversal::brute_force ||
                     (settings.traversal == Traversal::automatic && primitives <= brute_force_limit(lanes));
  const int tree_lanes = brute ? 0 : lanes;
  HostScene host;
  if (known != nullptr && known->geometry && known->lanes == tree_lanes &&
      known->geometry->in_double == settings.double_precision)
    host.geometry = known->geometry;
  else
    host.geometry =
        std::make_shared<accel::Geometry>(brute ? accel::brute_force(scene, settings.double_precision)
                                                : accel::hierarchy(scene, lanes, settings.double_precision));
  if (known != nullptr) *known = {host.geometry, tree_lanes};
  if (host.geometry->primitive_count == 0)
    throw SceneError(
        "no shape of the scene has an area that single precision can tell from 0: scale them up");
  host.lights = light_table(scene, *host.geometry, settings);
  host.materials =
      lobes::material_table(scene.materials, lobes::models_of(used_materials(scene, *host.geometry)));
  host.textures = texture_table(host.materials.textures);
  host.camera = camera_record(scene.camera, host.geometry->origin);
  return host;
}

} // namespace phlux::tables
