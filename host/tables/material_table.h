// Materials as the kernels read them, and the tabulated reflectivity of their lobes.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "scene_data.h"

namespace phlux::render {

/// Intervals of a row of the reflectivity table, evenly spaced in the cosine.
inline constexpr int reflectivity_intervals = 1024;

/// rho_s / ks of the modified Phong lobe of exponent n >= 0 for light whose angle with the normal has this
/// cosine (0 to 1): CW 197's integral over cos^n(alpha) cos(theta), in closed form. Relative error below
/// 1e-9.
[[nodiscard]] double lobe_reflectivity(double exponent, double cosine);

struct MaterialTable {
  std::vector<MaterialRecord> records;
  std::vector<float> reflectivity; ///< one row of reflectivity_intervals + 1 values per distinct exponent
};

[[nodiscard]] MaterialTable material_table(const std::vector<scene::Material>& materials);

} // namespace phlux::render
