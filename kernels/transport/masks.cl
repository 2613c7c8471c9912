// Masks, surfaces of partial opacity: at a point of opacity a the fraction 1 - a of the light passes in a straight
// line, and the material scatters the fraction a. The point is a vertex of a path only if the path is scattered there.
// An edge may pass any number of masks; its transmittance is the product of their 1 - a. Subpaths choose at random at
// each mask whether they pass; shadow rays are multiplied by the transmittance. The transmittance is the same for all
// techniques that make a path, so that weights do not depend on it.
#ifndef PHLUX_MASKS_CL
#define PHLUX_MASKS_CL

#include "lobes/material.cl"
#include "scene/surface.cl"

// The opacity of the material at a point in the lanes of m, per channel.
static inline Vec3 opacity_at(const Scene* scene, SurfacePoint point, Mask m) {
  const Vec3 opaque = vec_all((Real)(1.0f));
  const Mask masked = m & ((material_int(scene, point.material, MATERIAL_FLAGS) & MATERIAL_MASKED) != 0);
  if (!any_lane(masked)) return opaque;
  Vec3 opacity = material_vec(scene, point.material, MATERIAL_OPACITY);
  if (HAS_TEXTURES) opacity = textured_colour(scene, point.material, MATERIAL_OPACITY, point.uv, masked, opacity);
  return vec_select(masked, opacity, opaque);
}

// Moves the origin of the ray in the lanes of m beyond a point that it has hit. Returns the distance along the ray by
// which it moved.
static inline Real pass_point(Ray* ray, SurfacePoint point, Mask m) {
  const Vec3 origin = offset_origin(point.position, point.normal, point.error, ray->direction);
  const Real moved = vec_dot(vec_sub(origin, ray->origin), ray->direction);
  ray->origin = vec_select(m, origin, ray->origin);
  return m ? moved : (Real)(0.0f);
}

// Finds the first surface along the ray that scatters or absorbs the subpath, in the lanes of `alive`. Multiplies
// *throughput by opacity or transmittance, divided by the probability of the choice; the quotient is 1 if the opacity
// is grey. All choices use further_word of `words`.
static inline Hit first_scattering(const Scene* scene, Ray ray, RandomWords words, Vec3* throughput, Mask alive) {
  Hit hit;
  hit.distance = (Real)(0.0f);
  hit.primitive = (Int)(-1);
  Mask passing = alive;
  for (uint number = 1; any_lane(passing); ++number) {
    const Hit next = scene_intersect(scene, ray, passing);
    hit.distance += passing ? next.distance : (Real)(0.0f);
    hit.primitive = passing ? next.primitive : hit.primitive;
    passing &= next.primitive >= 0;
    if (!any_lane(passing)) break;
    const SurfacePoint point = surface_point(scene, ray, next);
    const Vec3 opacity = opacity_at(scene, point, passing);
    const Real stopping = vec_mean(opacity);
    const Mask stops = uniform_real(further_word(words.x, words.y, (Uint)(number))) < stopping;
    const Vec3 chosen = vec_select(stops, opacity, vec_sub(vec_all((Real)(1.0f)), opacity));
    const Vec3 weighted = vec_scale(1.0f / (stops ? stopping : 1.0f - stopping), vec_mul(chosen, *throughput));
    *throughput = vec_select(passing, weighted, *throughput);
    passing &= !stops;
    const Real moved = pass_point(&ray, point, passing);
    hit.distance += passing ? moved - next.distance : (Real)(0.0f);
  }
  return hit;
}

// Lanes of `asking` whose shadow ray hits an opaque surface before `distance`. Multiplies *light, the contribution of
// the ray, by the transmittance of the masks that the ray passes.
static inline Mask shadow_ray_blocked(const Scene* scene, Ray ray, Real distance, Vec3* light, Mask asking) {
  if (!HAS_MASKS) return scene_occluded(scene, ray, distance, asking);
  Mask passing = asking;
  while (any_lane(passing)) {
    const Hit hit = scene_intersect(scene, ray, passing);
    passing &= (hit.primitive >= 0) & (hit.distance < distance);
    if (!any_lane(passing)) break;
    const SurfacePoint point = surface_point(scene, ray, hit);
    const Vec3 transmittance = vec_sub(vec_all((Real)(1.0f)), opacity_at(scene, point, passing));
    *light = vec_select(passing, vec_mul(transmittance, *light), *light);
    passing &= !(vec_max(*light) <= 0.0f); // NaN passes, so that it is counted
    distance -= pass_point(&ray, point, passing);
  }
  return asking & (vec_max(*light) <= 0.0f);
}

#endif
