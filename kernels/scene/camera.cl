// The pinhole camera.
#ifndef PHLUX_CAMERA_CL
#define PHLUX_CAMERA_CL

#include "scene/intersect.cl"
#include "scene/scene.cl"

// The ray through a point of a pixel, (u, v) in [0, 1]^2 from its upper left corner. Pixels count row by row.
static inline Ray camera_ray(const Scene* scene, Uint pixel, Real u, Real v) {
  const __global CameraRecord* camera = scene->camera;
  const float width = (float)camera->width, height = (float)camera->height;
  const Int row = row_of(uint_to_int(pixel), camera->width);
  const Int column = uint_to_int(pixel) - row * camera->width;
  const Real x = (to_real(column) + u) / width + camera->principal_x;
  const Real y = (to_real(row) + v) / height + camera->principal_y;
  Ray ray;
  ray.origin = broadcast_vec(camera->position);
  ray.direction =
      vec_normalize(vec_along(vec_along(broadcast_vec(camera->forward), 1.0f - 2.0f * x, broadcast_vec(camera->left)),
                              1.0f - 2.0f * y, broadcast_vec(camera->up)));
  return ray;
}

// The density of camera_ray over the whole film, per solid angle at the eye: 1 / (film area x cos^3).
static inline Real film_density(const Scene* scene, Real cosine) {
  return 1.0f / (scene->camera->film_area * cosine * cosine * cosine);
}

// How the camera sees the direction `from_eye` (unit).
typedef struct {
  Mask seen;    // in front of the camera and on the film
  Int pixel;    // which pixel it is in
  Real density; // film_density there
} FilmPoint;

static inline FilmPoint camera_sees(const Scene* scene, Vec3 from_eye) {
  const __global CameraRecord* camera = scene->camera;
  const float width = (float)camera->width, height = (float)camera->height;
  const Vec3 left = broadcast_vec(camera->left), up = broadcast_vec(camera->up);
  const Real cosine = vec_dot(from_eye, broadcast_vec(camera->forward));
  const Real x = 0.5f - 0.5f * vec_dot(from_eye, left) / (cosine * vec_dot(left, left)) - camera->principal_x;
  const Real y = 0.5f - 0.5f * vec_dot(from_eye, up) / (cosine * vec_dot(up, up)) - camera->principal_y;
  // Floor, not a cast: a cast would draw in light from beyond the left and upper borders.
  const Real column = floor(x * width), row = floor(y * height);
  FilmPoint point;
  point.seen = (cosine > 0.0f) & (column >= 0.0f) & (column < width) & (row >= 0.0f) & (row < height);
  const Int first = (Int)(0);
  point.pixel = (point.seen ? to_int(row) : first) * camera->width + (point.seen ? to_int(column) : first);
  point.density = film_density(scene, cosine);
  return point;
}

static inline FilmPoint select_film(Mask m, FilmPoint yes, FilmPoint no) {
  FilmPoint point;
  point.seen = (m & yes.seen) | ((!m) & no.seen);
  point.pixel = m ? yes.pixel : no.pixel;
  point.density = m ? yes.density : no.density;
  return point;
}

#endif
