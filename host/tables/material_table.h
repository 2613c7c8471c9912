// Materials as the kernels read them, and the tabulated reflectivity of their lobes.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "scene/scene_data.h"

namespace phlux::tables {

struct MaterialTable {
  std::vector<MaterialRecord> records;
  std::vector<float> reflectivity; ///< a row of phong::append_reflectivities() per distinct exponent
};

[[nodiscard]] MaterialTable material_table(const std::vector<scene::Material>& materials);

} // namespace phlux::tables
