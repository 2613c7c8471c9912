#include "tables/used_materials.h"

namespace phlux::tables {

std::vector<scene::Material> used_materials(const scene::Scene& scene, const accel::Geometry& geometry) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const PrimitiveRecord& p : geometry.primitives)
    if (p.region != REGION_NONE) used[static_cast<std::size_t>(p.material)] = true;
  std::vector<scene::Material> materials;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) materials.push_back(scene.materials[i]);
  return materials;
}

} // namespace phlux::tables
