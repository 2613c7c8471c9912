// All tables of a scene.
#pragma once

#include <memory>

#include "accel/geometry.h"
#include "lobes/program.h"
#include "scene/scene.h"
#include "settings/settings.h"
#include "tables/light_table.h"
#include "tables/texture_table.h"

namespace phlux::tables {

/// The tables of a scene for one WIDTH and these settings.
struct HostScene {
  std::shared_ptr<accel::Geometry> geometry; ///< never null
  LightTable lights;
  lobes::MaterialTable materials;
  TextureTable textures;
  CameraRecord camera{};
};

/// The geometry of the last HostScene that was prepared with it. The next one uses it again if it has the
/// same WIDTH, traversal and precision.
struct KnownGeometry {
  std::shared_ptr<accel::Geometry> geometry; ///< null at first
  int lanes = 0;                             ///< 0: brute force
};

/// `known`: of a scene that differs only in its camera. @throws SceneError when the scene has no shape with
/// an area
[[nodiscard]] HostScene prepare(const scene::Scene& scene, const settings::Settings& settings, int lanes,
                                KnownGeometry* known = nullptr);

} // namespace phlux::tables
