// Albedo, shading normal and depth of the first surface that camera rays hit, for denoisers and compositing.
#include "transport/eye_subpath.cl"

// The mean of values and the sum of their squared deviations from it.
typedef struct {
  Vec3 mean, squares;
} Deviations;

// Adds the `count`-th value in the lanes of m (Welford 1962): equal values have a sum of exactly 0.
static inline void add_value(Deviations* all, Vec3 value, Real count, Mask m) {
  const Vec3 difference = vec_sub(value, all->mean);
  const Vec3 mean = vec_along(all->mean, 1.0f / count, difference);
  const Vec3 squares = vec_add(all->squares, vec_mul(difference, vec_sub(value, mean)));
  all->mean = vec_select(m, mean, all->mean);
  all->squares = vec_select(m, squares, all->squares);
}

// The variance of the mean of `count` values, estimated from these; 0 for fewer than two values.
static inline Vec3 variance_of_mean(Deviations all, Real count) {
  return vec_scale(1.0f / (count * larger(count - 1.0f, (Real)(1.0f))), all.squares);
}

// Lane l of the launch takes pixel first_pixel + l. `features` receives its FeatureWords, means over the pixel's first
// `samples` samples: albedo and normal are 0 for rays that hit nothing; depth is the mean over those that do, 0 if none
// does.
__kernel void trace_first_hits(SCENE_PARAMETERS, int first_pixel, int pixel_count, int first_sample, int samples,
                               uint2 seed, __global float* features) {
  SCENE_FROM_PARAMETERS
  const PathLimits limits = {2, 2};
  const PointSets no_sets = {0u, 0u};
  const Int lane = (int)get_global_id(0) * LANES + LANE_NUMBERS;
  const Mask active = lane < pixel_count;
  Subpath path = no_subpath(seed, no_sets);
  path.sequence.pixel = int_to_uint(first_pixel + (active ? lane : (Int)(0)));
  const Vec3 zero = vec_all((Real)(0.0f));
  Deviations albedo = {zero, zero}, normal = albedo, depth = albedo;
  Real hits = (Real)(0.0f);
  for (int sample = 0; sample < samples; ++sample) {
    path.sequence.sample = (Uint)((uint)(first_sample + sample));
    start_at_camera(&scene, &path);
    const Real cosine = vec_dot(path.ray.direction, broadcast_vec(camera->forward));
    const Arrival arrival = next_vertex(&scene, &path, 0, limits, active);
    const Vec3 reflectivity = material_reflectivity(arrival.vertex.material, arrival.vertex.fixed);
    const Real count = (Real)((float)(sample + 1));
    hits += arrival.hits ? (Real)(1.0f) : (Real)(0.0f);
    add_value(&albedo, vec_select(arrival.scattered, reflectivity, zero), count, active);
    add_value(&normal, vec_select(arrival.hits, arrival.vertex.point.frame.z, zero), count, active);
    add_value(&depth, vec_all(arrival.distance * cosine), larger(hits, (Real)(1.0f)), arrival.hits);
  }
  const Real count = (Real)((float)samples), depth_count = larger(hits, (Real)(1.0f));
  const Int slot = lane * FEATURE_WORDS, variances = slot + FEATURE_VARIANCES;
  scatter_vec(features + FEATURE_ALBEDO, slot, albedo.mean, active);
  scatter_vec(features + FEATURE_NORMAL, slot, normal.mean, active);
  scatter_real(features + FEATURE_DEPTH, slot, depth.mean.x, active);
  scatter_vec(features + FEATURE_ALBEDO, variances, variance_of_mean(albedo, count), active);
  scatter_vec(features + FEATURE_NORMAL, variances, variance_of_mean(normal, count), active);
  scatter_real(features + FEATURE_DEPTH, variances, variance_of_mean(depth, depth_count).x, active);
}
