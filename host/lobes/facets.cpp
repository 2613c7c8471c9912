#include "lobes/facets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "phong/reflectivity.h"

namespace phlux::lobes {
namespace {

constexpr double pi = std::numbers::pi;

double phong_exponent(double alpha) {
  return 2 / (alpha * alpha) - 2;
}

/// sigma, the area that facets show per area of the surface (kernels/lobes/microfacets.h).
double projected_area(FacetDistribution distribution, double alpha, double cosine) {
  const double spread = alpha * std::sqrt(1 - cosine * cosine);
  switch (distribution) {
  case FacetDistribution::ggx:
    return (cosine + std::hypot(cosine, spread)) / 2;
  case FacetDistribution::phong:
    return phong::lobe_reflectivity(phong_exponent(alpha), cosine);
  case FacetDistribution::beckmann:
    break;
  }
  if (spread == 0) return cosine;
  const double a = cosine / spread;
  return cosine + spread * std::exp(-a * a) / (2 * std::sqrt(pi)) - cosine * std::erfc(a) / 2;
}

/// The cosine of the facet's normal below which the part `u` of the projected area of all facets lies.
double facet_cosine(FacetDistribution distribution, double alpha, double u) {
  switch (distribution) {
  case FacetDistribution::ggx:
    return std::sqrt((1 - u) / (1 - u + alpha * alpha * u));
  case FacetDistribution::phong:
    return std::pow(1 - u, 1 / (phong_exponent(alpha) + 2));
  case FacetDistribution::beckmann:
    break;
  }
  return 1 / std::sqrt(1 - alpha * alpha * std::log1p(-u));
}

/// Of the light from `in` on a facet, the part that the facet refracts and no other blocks.
double transmitted(FacetDistribution distribution, double alpha, double index, const glm::dvec3& in,
                   const glm::dvec3& h) {
  const double cosine = glm::dot(in, h), square = index * index - 1 + cosine * cosine;
  if (cosine <= 0 || square <= 0) return 0;
  const double out = (cosine * h.z - in.z - std::sqrt(square) * h.z) / index; // z of the refracted direction
  if (out >= 0) return 0;
  const double masking = -out / projected_area(distribution, alpha, std::min(1.0, -out));
  return (1 - fresnel_reflectance(cosine, index)) * masking;
}

/// Of the light from `in` on a facet, the part that the facet reflects and no other blocks.
double reflected(FacetDistribution distribution, double alpha, double index, const glm::dvec3& in,
                 const glm::dvec3& h) {
  const double cosine = glm::dot(in, h), out = 2 * cosine * h.z - in.z;
  if (cosine <= 0 || out <= 0) return 0;
  return fresnel_reflectance(cosine, index) * out / projected_area(distribution, alpha, std::min(1.0, out));
}

} // namespace

double fresnel_reflectance(double cosine, double index) {
  const double square = index * index - 1 + cosine * cosine;
  if (square <= 0) return 1;
  const double bent = std::sqrt(square);
  const double s = (cosine - bent) / (cosine + bent);
  const double p = (index * index * cosine - bent) / (index * index * cosine + bent);
  return (s * s + p * p) / 2;
}

double diffuse_reflectance(double index) {
  constexpr int steps = 20000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += fresnel_reflectance(std::sqrt((i + 0.5) / steps), index);
  return sum / steps;
}

namespace {

/// The mean over the facets that light of this cosine sees of `part(in, h)`.
template<class Part>
double mean_over_facets(FacetDistribution distribution, double alpha, double cosine, Part part) {
  constexpr int steps = 48, turns = 48; // the facets' slopes, and half a turn about the normal
  const glm::dvec3 in(std::sqrt(1 - cosine * cosine), 0, cosine);
  double sum = 0;
  for (int k = 0; k < steps; ++k) {
    const double z = facet_cosine(distribution, alpha, (k + 0.5) / steps), sine = std::sqrt(1 - z * z);
    for (int j = 0; j < turns; ++j) {
      const double phi = (j + 0.5) / turns * pi;
      const glm::dvec3 h(sine * std::cos(phi), sine * std::sin(phi), z);
      sum += std::max(0.0, glm::dot(in, h)) / z * part(in, h);
    }
  }
  return sum / (steps * turns * projected_area(distribution, alpha, cosine));
}

} // namespace

std::vector<double> rough_transmittances(FacetDistribution distribution, double alpha, double index,
                                         int intervals) {
  std::vector<double> values;
  for (int i = 0; i <= intervals; ++i)
    values.push_back(mean_over_facets(distribution, alpha, std::max(static_cast<double>(i) / intervals, 1e-6),
                                      [&](const glm::dvec3& in, const glm::dvec3& h) {
                                        return transmitted(distribution, alpha, index, in, h);
                                      }));
  return values;
}

double rough_internal_reflectance(FacetDistribution distribution, double alpha, double index) {
  constexpr int cosines = 64;
  double sum = 0; // of R 2 cos, by the midpoint rule
  for (int i = 0; i < cosines; ++i) {
    const double cosine = (i + 0.5) / cosines;
    sum += 2 * cosine *
           mean_over_facets(distribution, alpha, cosine, [&](const glm::dvec3& in, const glm::dvec3& h) {
             return reflected(distribution, alpha, 1 / index, in, h);
           });
  }
  return sum / cosines;
}

} // namespace phlux::lobes
