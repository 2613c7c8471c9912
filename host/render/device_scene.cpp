#include "render/device_scene.h"

#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "errors.h"
#include "tables/used_materials.h"

namespace phlux::render {
namespace {

// Up to so many primitives, testing each in turn is as fast as a hierarchy: where the two rates crossed on
// bounce rays in a closed room (bench/PERFORMANCE.md).
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
  record.width = camera.width;
  record.height = camera.height;
  return record;
}

// A table of entries of so many elements each. Kernels may load the first few_entries whole: there are as
// many, though the table be empty.
template<typename T>
cl::Buffer upload(const device::Device& device, const std::vector<T>& table, const char* what,
                  std::size_t elements_per_entry = 1) {
  const std::size_t least = few_entries * elements_per_entry;
  if (table.size() < least) {
    std::vector<T> longer = table;
    longer.resize(least);
    return upload(device, longer, what, elements_per_entry);
  }
  const std::size_t bytes = table.size() * sizeof(T);
  if (bytes > device.info.largest_buffer)
    throw DeviceError(
        fmt::format("{}: the scene's {} take {} MB and a buffer may have {} MB: use a device with more "
                    "memory or a smaller mesh",
                    device.info.name, what, bytes >> 20, device.info.largest_buffer >> 20));
  try {
    return cl::Buffer(device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, bytes,
                      const_cast<T*>(table.data()));
  } catch (const cl::Error& error) {
    throw DeviceError(fmt::format("{}: no room for the scene's {} ({} MB): {}", device.info.name, what,
                                  bytes >> 20, device::error_name(error.err())));
  }
}

} // namespace

HostScene prepare(const scene::Scene& scene, Traversal traversal, int lanes, bool double_precision,
                  bool tree_of_lights) {
  const std::uint64_t primitives = accel::count_primitives(scene);
  if (primitives == 0) throw SceneError("the scene has no shapes: add at least one that the camera can see");
  const bool brute = traversal == Traversal::brute_force ||
                     (traversal == Traversal::automatic && primitives <= brute_force_limit(lanes));
  HostScene host;
  host.geometry =
      brute ? accel::brute_force(scene, double_precision) : accel::hierarchy(scene, lanes, double_precision);
  if (host.geometry.primitive_count == 0)
    throw SceneError(
        "no shape of the scene has an area that single precision can tell from 0: scale them up");
  host.lights = tables::light_table(scene, host.geometry, tree_of_lights);
  host.materials =
      lobes::material_table(scene.materials, lobes::models_of(tables::used_materials(scene, host.geometry)));
  host.camera = camera_record(scene.camera, host.geometry.origin);
  return host;
}

DeviceScene::DeviceScene(const device::Device& device, const HostScene& scene, const Parts& parts)
    : light_count_(static_cast<int>(scene.lights.records.size())), triangle_end_(scene.geometry.triangle_end),
      parallelogram_end_(scene.geometry.parallelogram_end), ellipse_end_(scene.geometry.ellipse_end),
      first_sphere_(scene.geometry.first_sphere), sphere_count_(scene.geometry.sphere_count),
      root_(scene.geometry.root), light_tree_probability_(static_cast<float>(scene.lights.tree_probability)),
      camera_(upload(device, std::vector<CameraRecord>{scene.camera}, "camera")),
      primitives_(upload(device, scene.geometry.primitives, "primitives")),
      materials_(upload(device, scene.materials.records, "materials",
                        scene.materials.records.size() / scene.materials.count)),
      lights_(upload(device, scene.lights.records, "lights")),
      planars_(parts.double_precision
                   ? upload(device, scene.geometry.double_planars, "triangles", PLANAR_FLOATS)
                   : upload(device, scene.geometry.planars, "triangles", PLANAR_FLOATS)),
      spheres_(parts.double_precision
                   ? upload(device, scene.geometry.double_spheres, "spheres", SPHERE_FLOATS)
                   : upload(device, scene.geometry.spheres, "spheres", SPHERE_FLOATS)),
      nodes_(upload(device, scene.geometry.nodes, "hierarchy")),
      light_nodes_(upload(device, scene.lights.nodes, "tree of lights")),
      lobe_tables_(upload(device, scene.materials.tables, "reflectivities")),
      corners_(upload(device, scene.geometry.corners, "triangles' corners")),
      vertex_normals_(upload(device, scene.geometry.vertex_normals, "vertex normals")) {}

void DeviceScene::bind(device::Kernel& kernel) const {
  kernel.set("camera", camera_);
  kernel.set("primitives", primitives_);
  kernel.set("materials", materials_);
  kernel.set("lights", lights_);
  kernel.set("light_count", light_count_);
  kernel.set("planars", planars_);
  kernel.set("triangle_end", triangle_end_);
  kernel.set("parallelogram_end", parallelogram_end_);
  kernel.set("ellipse_end", ellipse_end_);
  kernel.set("spheres", spheres_);
  kernel.set("first_sphere", first_sphere_);
  kernel.set("sphere_count", sphere_count_);
  kernel.set("nodes", nodes_);
  kernel.set("root", root_);
  kernel.set("light_nodes", light_nodes_);
  kernel.set("light_tree_probability", light_tree_probability_);
  kernel.set("lobe_tables", lobe_tables_);
  kernel.set("corners", corners_);
  kernel.set("vertex_normals", vertex_normals_);
}

} // namespace phlux::render
