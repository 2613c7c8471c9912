// The pinhole camera.
#ifndef PHLUX_CAMERA_CL
#define PHLUX_CAMERA_CL

#include "intersect.cl"
#include "scene.cl"

static inline Vec3 camera_vector(const __global float* v) { return vec3((Real)(v[0]), (Real)(v[1]), (Real)(v[2])); }

// The ray through a point of a pixel, (u, v) in [0, 1]^2 from its upper left corner. Pixels count row by row.
static inline Ray camera_ray(const Scene* scene, Uint pixel, Real u, Real v) {
  const __global CameraRecord* camera = scene->camera;
  const float width = (float)camera->width, height = (float)camera->height;
  // A quotient of floats, off by one at most for a film of less than 2^22 rows, and put right.
  Int row = to_int(uint_to_real(pixel) / width);
  Int column = uint_to_int(pixel) - row * camera->width;
  row = column < 0 ? row - 1 : (column >= camera->width ? row + 1 : row);
  column = uint_to_int(pixel) - row * camera->width;
  const Real x = (to_real(column) + u) / width + camera->principal_x;
  const Real y = (to_real(row) + v) / height + camera->principal_y;
  Ray ray;
  ray.origin = camera_vector(camera->position);
  ray.direction =
      vec_normalize(vec_along(vec_along(camera_vector(camera->forward), 1.0f - 2.0f * x, camera_vector(camera->left)),
                              1.0f - 2.0f * y, camera_vector(camera->up)));
  return ray;
}

#endif
