// Exact reflected radiance of a Phong material under the incident light of `phlux bench sampling`, in double
// precision.
#pragma once

#include <string>
#include <vector>

#include "bench/common/case.h"

namespace phlux::bench {

/// Incident light over the hemisphere; kernels/measure/sampling_radiance.h defines the radiances.
enum class Light { constant, mirror_disk, horizon_sky };

/// In the order of Light: constant, mirror-disk, horizon-sky.
[[nodiscard]] const std::vector<std::string>& light_names();

/// Reflected radiance: the integral of f_r L_i cos(theta) over the hemisphere. For Light::constant this is
/// the reflectivity, in closed form; else by quadrature over circles about the axis of the lobe, with a
/// relative error below 1e-7.
[[nodiscard]] double reflected_radiance(const Case& one, Light light);

/// The same by quadrature, for every kind of light.
[[nodiscard]] double integrated_radiance(const Case& one, Light light);

} // namespace phlux::bench
