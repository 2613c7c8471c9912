// Integrals over dielectric surfaces, smooth or of microfacets (kernels/lobes/microfacets.h).
#pragma once

#include <vector>

namespace phlux::lobes {

/// Fresnel's reflectance of unpolarised light that arrives at an angle of this cosine at a medium of relative
/// index of refraction `index`.
[[nodiscard]] double fresnel_reflectance(double cosine, double index);

/// The fraction of diffuse light that a smooth surface reflects.
[[nodiscard]] double diffuse_reflectance(double index);

enum class FacetDistribution { beckmann, ggx, phong };

/// The fraction of the light that a rough surface transmits by one refraction, at `intervals` + 1 cosines
/// evenly spaced from 0 to 1; relative error about 1e-3.
[[nodiscard]] std::vector<double> rough_transmittances(FacetDistribution distribution, double alpha,
                                                       double index, int intervals);

/// The fraction of diffuse light inside that the surface reflects back by one reflection; relative error
/// about 1e-3. The rest that is not refracted either is blocked by other facets.
[[nodiscard]] double rough_internal_reflectance(FacetDistribution distribution, double alpha, double index);

} // namespace phlux::lobes
