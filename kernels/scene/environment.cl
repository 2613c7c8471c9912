// The environment map: radiance from every direction at infinity, interpolated bilinearly between the texels of an
// image in latitude and longitude, whose rows begin at the pole +y of the map's frame (EnvironmentRecord). Directions
// are sampled in proportion to the mean of the channels of the radiance: first a texel by the alias method, in
// proportion to its mean over the channels times the solid angle of its weight in the interpolation; then an offset
// from the centre of the texel by these weights, which decrease linearly to 0 at the centres of the neighbours.
//
// The density interpolates rows as sin(theta_j) texel_j / sin(theta), so that it is linear in rows and columns for the
// offset; the radiance interpolates the texels themselves. In the cap between the centre of the last row and the pole,
// the radiance does not depend on theta, and the density is uniform in solid angle.
#ifndef PHLUX_ENVIRONMENT_CL
#define PHLUX_ENVIRONMENT_CL

#include "math/directions.h"
#include "math/random.h"
#include "scene/scene.cl"

typedef struct {
  Vec3 radiance;
  Real density; // of sample_environment, per solid angle; 0 where the radiance is 0
} Environment;

// sin(theta) at the centre of a row, computed from the nearer pole.
static inline Real row_sine(Int row, int height) {
  Real cosine, sine;
  cos_sin_turns((to_real(min(row, height - 1 - row)) + 0.5f) * (0.5f / (float)height), &cosine, &sine);
  return sine;
}

// The radiance of a row, interpolated between two columns with the fraction `across`.
static inline Vec3 row_radiance(const Scene* scene, Int row_start, Int column, Int next_column, Real across) {
  const Vec3 left = GATHER_VEC3(scene->environment_texels, row_start + column, radiance);
  const Vec3 right = GATHER_VEC3(scene->environment_texels, row_start + next_column, radiance);
  return vec_along(vec_scale(1.0f - across, left), across, right);
}

// Radiance and density for `direction` (unit, towards the sky). Indices are clamped for directions that are not finite.
static inline Environment environment_towards(const Scene* scene, Vec3 direction) {
  const __global EnvironmentRecord* map = scene->environment;
  const int width = map->width, height = map->height;
  const Real x = vec_dot(direction, broadcast_vec(map->x)), y = vec_dot(direction, broadcast_vec(map->y));
  const Real z = vec_dot(direction, broadcast_vec(map->z));
  const Real sine = sqrt(fma(x, x, z * z));
  const Real column = atan2pi(x, -z) * (0.5f * (float)width) - 0.5f;
  const Real row = atan2pi(sine, y) * (float)height - 0.5f;
  const Real left = floor(column), above = floor(row);
  const Real across = column - left, down = row - above;
  Int first = to_int(left);
  first = clamp(first < 0 ? first + width : first, (Int)(0), (Int)(width - 1));
  const Int second = first == width - 1 ? (Int)(0) : first + 1;
  const Int upper = clamp(to_int(above), (Int)(0), (Int)(height - 1));
  const Int lower = clamp(to_int(above) + 1, (Int)(0), (Int)(height - 1));

  const Vec3 from_upper = vec_scale(1.0f - down, row_radiance(scene, upper * width, first, second, across));
  const Vec3 from_lower = vec_scale(down, row_radiance(scene, lower * width, first, second, across));
  const Mask cap = upper == lower;
  const Real upper_ratio = cap ? (Real)(1.0f) : row_sine(upper, height) / sine;
  const Real lower_ratio = cap ? (Real)(1.0f) : row_sine(lower, height) / sine;
  Environment e;
  e.radiance = vec_add(from_upper, from_lower);
  e.density = map->density * fma(upper_ratio, vec_sum(from_upper), lower_ratio * vec_sum(from_lower));
  return e;
}

// Samples a direction with the density of environment_towards.
static inline Vec3 sample_environment(const Scene* scene, RandomWords words) {
  const __global EnvironmentRecord* map = scene->environment;
  const int width = map->width, height = map->height;
  const Int cell = uint_to_int(mul_hi(words.x, (Uint)((uint)width * (uint)height)));
  const Mask keep = words.y < int_to_uint(GATHER_INT(scene->environment_texels, cell, threshold));
  const Int texel = keep ? cell : GATHER_INT(scene->environment_texels, cell, alias);
  const Int row = quotient(texel, width);
  const Int column = texel - row * width;

  const Real around = (to_real(column) + 0.5f + tent_offset(uniform_real(words.z))) / (float)width;
  // Above or below the centre of the texel; a row at a pole has a cap on one side.
  const Mask first = row == 0, last = row == height - 1;
  const Real above_share = first ? (Real)(map->cap_share) : (last ? (Real)(1.0f - map->cap_share) : (Real)(0.5f));
  const Real v = uniform_real(words.w);
  const Mask above = v < above_share;
  const Real within = above ? v / above_share : (1.0f - v) / (1.0f - above_share);
  const Mask cap = (above & first) | ((!above) & last);
  const Real offset = 1.0f - sqrt(within);
  const Real from_north = to_real(row) + 0.5f + (above ? -offset : offset);
  const Mask south = cap ? (Mask)(!above) : (Mask)(from_north > 0.5f * (float)height);
  const Real turns = (south ? (float)height - from_north : from_north) * (0.5f / (float)height);
  Real cosine, sine;
  cos_sin_turns(clamp(turns, (Real)(0.0f), (Real)(0.25f)), &cosine, &sine);
  const Real drop = within * map->cap; // 1 - cos(theta)
  sine = cap ? sqrt(drop * (2.0f - drop)) : sine;
  cosine = cap ? 1.0f - drop : cosine;

  Real cos_phi, sin_phi;
  cos_sin_turns(around < 0.0f ? around + 1.0f : (around > 1.0f ? around - 1.0f : around), &cos_phi, &sin_phi);
  const Vec3 horizontal =
      vec_along(vec_scale(sine * sin_phi, broadcast_vec(map->x)), -sine * cos_phi, broadcast_vec(map->z));
  return vec_along(horizontal, south ? -cosine : cosine, broadcast_vec(map->y));
}

#endif
