// Adaptive quadrature of a reflectance function over the hemisphere.
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace phlux::bench {

/// f_r for many unit directions of three floats each.
using Evaluation = std::function<std::vector<float>(const std::vector<float>& directions)>;

/// The integral of f_r cos(theta) over solid angle. Cells of (theta, phi), each by a Gauss rule of 5 x 5
/// points, are divided until dividing changes the integral by less than 1e-7 of it; around each of `peaks`,
/// unit directions where f_r may be narrow, until they are 3e-3 wide.
[[nodiscard]] double hemisphere_integral(const Evaluation& evaluate,
                                         const std::vector<std::array<double, 3>>& peaks);

} // namespace phlux::bench
