// Albedo, shading normal and depth of the first surface that camera rays hit, for denoisers and compositing.
#include "transport/eye_subpath.cl"

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
  Vec3 albedo = vec_all((Real)(0.0f)), normal = albedo;
  Real depth = (Real)(0.0f), hits = (Real)(0.0f);
  for (int sample = 0; sample < samples; ++sample) {
    path.sequence.sample = (Uint)((uint)(first_sample + sample));
    start_at_camera(&scene, &path);
    const Real cosine = vec_dot(path.ray.direction, broadcast_vec(camera->forward));
    const Arrival arrival = next_vertex(&scene, &path, 0, limits, active);
    const Vec3 reflectivity = material_reflectivity(arrival.vertex.material, arrival.vertex.fixed);
    albedo = vec_select(arrival.scattered, vec_add(albedo, reflectivity), albedo);
    normal = vec_select(arrival.hits, vec_add(normal, arrival.vertex.point.frame.z), normal);
    depth += arrival.hits ? arrival.distance * cosine : (Real)(0.0f);
    hits += arrival.hits ? (Real)(1.0f) : (Real)(0.0f);
  }
  const Real share = (Real)(1.0f / (float)samples);
  const Int slot = lane * FEATURE_WORDS;
  scatter_vec(features + FEATURE_ALBEDO, slot, vec_scale(share, albedo), active);
  scatter_vec(features + FEATURE_NORMAL, slot, vec_scale(share, normal), active);
  scatter_real(features + FEATURE_DEPTH, slot, hits > 0.0f ? depth / hits : (Real)(0.0f), active);
}
