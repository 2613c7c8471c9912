// Surfaces of partial opacity: at a point of opacity a, the part 1 - a of all light passes straight on, and the
// material scatters the part a. Such a point is a vertex of a path only if the path is scattered there: an edge passes
// through any number of masks, with the product of the parts 1 - a as its transmittance. Subpaths choose at each mask
// whether they pass; shadow rays carry the transmittance as a factor. It is the same for all techniques that make a
// path, and so has no part in their weights.
#ifndef PHLUX_MASKS_CL
#define PHLUX_MASKS_CL

#include "lobes/material.cl"
#include "scene/surface.cl"

// The opacity of a point's material in the lanes of m, by channel.
static inline Vec3 opacity_at(const Scene* scene, SurfacePoint point, Mask m) {
  const Vec3 opaque = vec_all((Real)(1.0f));
  const Mask masked = m & ((material_int(scene, point.material, MATERIAL_FLAGS) & MATERIAL_MASKED) != 0);
  if (!any_lane(masked)) return opaque;
  Vec3 opacity = vec3(material_real(scene, point.material, MATERIAL_OPACITY),
                      material_real(scene, point.material, MATERIAL_OPACITY + 1),
                      material_real(scene, point.material, MATERIAL_OPACITY + 2));
  if (HAS_TEXTURES) opacity = textured_colour(scene, point.material, MATERIAL_OPACITY, point.uv, masked, opacity);
  return vec_select(masked, opacity, opaque);
}

// Moves the origin of the ray in the lanes of m to the far side of a point that it has met. Returns by how much it
// moved along the ray.
static inline Real pass_point(Ray* ray, SurfacePoint point, Mask m) {
  const Vec3 origin = offset_origin(point.position, point.normal, point.error, ray->direction);
  const Real moved = vec_dot(vec_sub(origin, ray->origin), ray->direction);
  ray->origin = vec_select(m, origin, ray->origin);
  return m ? moved : (Real)(0.0f);
}

// The first surface along the ray that scatters a subpath of `alive` or absorbs it. Multiplies *throughput by the ratio
// of opacity, or of transmittance, to the probability of the choice: 1 if the opacity is grey. All choices are made
// with further_word of `words`.
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

// Lanes of `asking` whose shadow ray meets something opaque before `distance`. Multiplies *light, what the ray brings,
// by the transmittance of the masks on its way.
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
    passing &= vec_max(*light) > 0.0f;
    distance -= pass_point(&ray, point, passing);
  }
  return asking & !(vec_max(*light) > 0.0f);
}

#endif
