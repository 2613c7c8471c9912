// All tables of a scene.
#pragma once

#include "accel/geometry.h"
#include "lobes/program.h"
#include "scene/scene.h"
#include "settings/settings.h"
#include "tables/light_table.h"
#include "tables/texture_table.h"

namespace phlux::tables {

/// The tables of a scene for one WIDTH and these settings.
struct HostScene {
  accel::Geometry geometry;
  LightTable lights;
  lobes::MaterialTable materials;
  TextureTable textures;
  CameraRecord camera{};
};

/// @throws SceneError when the scene has no shape with an area
[[nodiscard]] HostScene prepare(const scene::Scene& scene, const settings::Settings& settings, int lanes);

} // namespace phlux::tables
