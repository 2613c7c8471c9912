// Integrals over dielectric surfaces, smooth or of microfacets (kernels/lobes/microfacets.h).
#pragma once

#include <vector>

namespace phlux::lobes {

/// Fresnel's reflectance of unpolarised light that arrives at an angle of this cosine at a medium of relative
/// index of refraction `index`.
[[nodiscard]] double fresnel_reflectance(double cosine, double index);

/// The part of diffuse light that a smooth surface reflects.
[[nodiscard]] double diffuse_reflectance(double index);

enum class FacetDistribution { beckmann, ggx, phong };

/// The part of the light that passes a rough surface after one refraction, at `intervals` + 1 cosines evenly
/// spaced from 0 to 1; relative error about 1e-3.
[[nodiscard]] std::vector<double> rough_transmittances(FacetDistribution distribution, double alpha,
                                                       double index, int intervals);

/// The part of diffuse light inside the surface that it sends back by one reflection; relative error about
/// 1e-3. What neither this nor a refraction sends on is blocked by other facets.
[[nodiscard]] double rough_internal_reflectance(FacetDistribution distribution, double alpha, double index);

} // namespace phlux::lobes
