#include "scene/camera.cl"
#include "transport/camera_packets.cl"

static inline CameraSample sample_at(Real u, Real v) {
  CameraSample sample;
  sample.x = u;
  sample.y = v;
  sample.lens_x = sample.lens_y = (Real)(0.0f);
  return sample;
}

// The camera's pixel and density for its own rays.
__kernel void see_rays(SCENE_PARAMETERS, __global const Uint* pixel, __global const Real* u, __global const Real* v,
                       __global Vec3* direction, __global Int* seen, __global Int* seen_pixel, __global Real* density,
                       __global Real* density_alone) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  const Ray ray = camera_ray(&scene, pixel[i], sample_at(u[i], v[i]));
  const FilmPoint point = camera_sees(&scene, ray.direction, sample_at(u[i], v[i]));
  direction[i] = ray.direction;
  seen[i] = point.seen ? (Int)(1) : (Int)(0);
  seen_pixel[i] = point.pixel;
  density[i] = point.density;
  density_alone[i] = film_density(&scene, vec_dot(ray.direction, broadcast_vec(scene.camera->forward)));
}

__kernel void see_directions(SCENE_PARAMETERS, __global const Vec3* direction, __global Int* seen,
                             __global Int* seen_pixel, __global Real* density) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  const FilmPoint point = camera_sees(&scene, direction[i], sample_at((Real)(0.5f), (Real)(0.5f)));
  seen[i] = point.seen ? (Int)(1) : (Int)(0);
  seen_pixel[i] = point.pixel;
  density[i] = point.density;
}

// The bounds of a packet, in every lane, and the inverse directions for near and far planes.
typedef struct {
  Vec3 origin, direction, across, down, fast_inverse, slow_inverse;
  Int same_signs;
} Bounds;

// The bounds of the camera rays through the points (u, v) of a pixel, the same pixel in every lane, and these rays.
__kernel void bound_pixels(SCENE_PARAMETERS, __global const Int* pixel, __global const Real* u, __global const Real* v,
                           __global const Int* counts, __global Bounds* bounds, __global Vec3* direction) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  PacketBounds packet;
  bound_camera_rays(&scene, int_to_uint(pixel[i]), sample_at(u[i], v[i]), counts[i] != 0, &packet);
  BoxRay fast;
  Vec3 far_inverse;
  bounds[i].same_signs = (Int)(bounding_rays(&packet, &fast, &far_inverse));
  bounds[i].slow_inverse = far_inverse;
  bounds[i].fast_inverse = fast.inverse;
  bounds[i].origin = vec_of(packet.origin);
  bounds[i].direction = vec_of(packet.direction);
  bounds[i].across = vec_of(packet.across);
  bounds[i].down = vec_of(packet.down);
  direction[i] = camera_ray(&scene, int_to_uint(pixel[i]), sample_at(u[i], v[i])).direction;
}
