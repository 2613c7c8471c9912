// What a material reflects of the kinds of light that `phlux bench sampling` lets arrive, in double
// precision.
#pragma once

#include <string>
#include <vector>

#include "bench/common/phong_program.h"

namespace phlux::bench {

/// The kinds of light of kernels/sampling_radiance.h, where their radiance is defined.
enum class Light { constant, mirror_disk, horizon_sky };

/// In the order of Light: constant, mirror-disk, horizon-sky.
[[nodiscard]] const std::vector<std::string>& light_names();

/// The reflected radiance, the integral of f_r cos(theta) times what arrives; the reflectivity for
/// Light::constant, which has a closed form. The others by quadrature over circles about the lobe's axis,
/// relative error below 1e-7.
[[nodiscard]] double reflected_radiance(const Case& one, Light light);

/// The same, by quadrature for every kind of light.
[[nodiscard]] double integrated_radiance(const Case& one, Light light);

} // namespace phlux::bench
