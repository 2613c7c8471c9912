// A scene's tables in a device's memory, and the arguments of a kernel that renders it.
#pragma once

#include "accel/geometry.h"
#include "device/kernel.h"
#include "render/parts.h"
#include "tables/light_table.h"

namespace phlux::render {

/// Everything that the host computes about a scene for one WIDTH, precision and traversal.
struct HostScene {
  accel::Geometry geometry;
  tables::LightTable lights;
  lobes::MaterialTable materials;
  CameraRecord camera{};
};

/// @throws SceneError when the scene has no shape with an area
[[nodiscard]] HostScene prepare(const scene::Scene& scene, Traversal traversal, int lanes,
                                bool double_precision = false, bool tree_of_lights = true);

class DeviceScene {
public:
  /// Copies the tables. @throws DeviceError when they do not fit, saying how large they are
  DeviceScene(const device::Device& device, const HostScene& scene, const Parts& parts);

  /// Sets the arguments that SCENE_PARAMETERS (kernels/scene/scene.cl) declares.
  void bind(device::Kernel& kernel) const;

private:
  int light_count_, triangle_end_, parallelogram_end_, ellipse_end_, first_sphere_, sphere_count_, root_;
  float light_tree_probability_;
  cl::Buffer camera_, primitives_, materials_, lights_, planars_, spheres_, nodes_, light_nodes_,
      lobe_tables_, corners_, vertex_normals_;
};

} // namespace phlux::render
