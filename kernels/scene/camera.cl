// The camera: a pinhole, a thin lens (HAS_LENS) or parallel rays (HAS_ORTHOGRAPHIC), and the film's reconstruction
// filter.
//
// Eye subpaths sample the filter: the radiance of a pixel is the mean over offsets from its centre with the filter's
// density. A splat adds to one pixel near its position on the film; the probability and the weight of that pixel are
// such that the mean is the same (filter_splat). The lens is sampled uniformly in both cases; its density cancels in
// weights.
#ifndef PHLUX_CAMERA_CL
#define PHLUX_CAMERA_CL

#include "math/constants.h"
#include "math/directions.h"
#include "math/random.h"
#include "scene/intersect.cl"
#include "scene/scene.cl"

#define HAS_FILTER (HAS_TENT_FILTER | HAS_GAUSSIAN_FILTER)

// Random numbers of the camera.
typedef struct {
  Real x, y;           // a point of a pixel, in pixels from its upper left corner; outside [0, 1] for wide filters
  Real lens_x, lens_y; // a point of the lens, in units of `left` and `up` of the camera's record
} CameraSample;

// 1 if light subpaths need a CameraSample: for a point of the lens, the offset of a splat, or a ray of an orthographic
// camera (see_sky).
#define HAS_CAMERA_SAMPLE (HAS_LENS | HAS_FILTER | HAS_ORTHOGRAPHIC)

// Samples the pixel uniformly or by the filter, and the lens uniformly.
static inline CameraSample camera_sample(const Scene* scene, RandomWords words) {
  CameraSample s;
  s.x = uniform_real(words.x);
  s.y = uniform_real(words.y);
  s.lens_x = s.lens_y = (Real)(0.0f);
  const __global CameraRecord* camera = scene->camera;
  if (HAS_TENT_FILTER) {
    s.x = 0.5f + camera->filter_size * tent_offset(s.x);
    s.y = 0.5f + camera->filter_size * tent_offset(s.y);
  }
  if (HAS_GAUSSIAN_FILTER) { // Box and Muller (1958)
    Real cosine, sine;
    cos_sin_turns(s.y, &cosine, &sine);
    const Real radius = camera->filter_size * sqrt(-2.0f * log(s.x));
    s.x = 0.5f + radius * cosine;
    s.y = 0.5f + radius * sine;
  }
  if (HAS_LENS) {
    Real cosine, sine;
    cos_sin_turns(uniform_real(words.w), &cosine, &sine);
    const Real radius = sqrt(uniform_real(words.z));
    s.lens_x = camera->lens[0] * radius * cosine;
    s.lens_y = camera->lens[1] * radius * sine;
  }
  return s;
}

static inline Vec3 lens_position(const Scene* scene, CameraSample sample) {
  const __global CameraRecord* camera = scene->camera;
  const Vec3 centre = broadcast_vec(camera->position);
  if (!HAS_LENS) return centre;
  return vec_along(vec_along(centre, sample.lens_x, broadcast_vec(camera->left)), sample.lens_y,
                   broadcast_vec(camera->up));
}

// A point of the image plane, in units of `left` and `up` of the camera's record.
typedef struct {
  Real leftwards, upwards;
} ImagePoint;

// The point of the image plane through which the ray of a sampled point of a pixel goes; with a lens, relative to the
// point of the lens. Pixels are numbered row by row.
static inline ImagePoint image_point(const Scene* scene, Uint pixel, CameraSample sample) {
  const __global CameraRecord* camera = scene->camera;
  const float width = (float)camera->width, height = (float)camera->height;
  const Int row = quotient(uint_to_int(pixel), camera->width);
  const Int column = uint_to_int(pixel) - row * camera->width;
  const Real x = (to_real(column) + sample.x) / width + camera->principal_x;
  const Real y = (to_real(row) + sample.y) / height + camera->principal_y;
  ImagePoint point;
  point.leftwards = 1.0f - 2.0f * x;
  point.upwards = 1.0f - 2.0f * y;
  if (HAS_LENS) { // towards the point of the plane in focus
    point.leftwards -= sample.lens_x * camera->inv_focus_distance;
    point.upwards -= sample.lens_y * camera->inv_focus_distance;
  }
  return point;
}

// The ray through a sampled point of a pixel.
static inline Ray camera_ray(const Scene* scene, Uint pixel, CameraSample sample) {
  const __global CameraRecord* camera = scene->camera;
  const ImagePoint point = image_point(scene, pixel, sample);
  const Vec3 start = broadcast_vec(HAS_ORTHOGRAPHIC ? camera->position : camera->forward);
  const Vec3 across = vec_along(vec_along(start, point.leftwards, broadcast_vec(camera->left)), point.upwards,
                                broadcast_vec(camera->up));
  Ray ray;
  ray.origin = HAS_ORTHOGRAPHIC ? across : lens_position(scene, sample);
  ray.direction = HAS_ORTHOGRAPHIC ? broadcast_vec(camera->forward) : vec_normalize(across);
  return ray;
}

// The density of camera_ray over the whole film, per solid angle at the eye: 1 / (film area x cos^3), where `cosine` is
// that of the angle to the axis of the camera. For parallel rays: per area perpendicular to them.
static inline Real film_density(const Scene* scene, Real cosine) {
  if (HAS_ORTHOGRAPHIC) return (Real)(1.0f / scene->camera->film_area);
  return 1.0f / (scene->camera->film_area * cosine * cosine * cosine);
}

// A direction or a point as the camera sees it.
typedef struct {
  Mask seen;    // in front of the camera and on the film
  Int pixel;    // which pixel it adds to
  Real density; // film_density there
  Real share;   // weight of the pixel by the filter
} FilmPoint;

// For one axis, in pixels: the density of the filter at `distance` from its centre, divided by the probability that an
// offset sampled from the filter (camera_sample) is within half a pixel of `distance`.
static inline Real filter_ratio(const Scene* scene, Real distance) {
  const float size = scene->camera->filter_size;
  const Real near = distance - 0.5f, far = distance + 0.5f;
  if (HAS_TENT_FILTER) { // the probability of an offset above x is (1 - x / size)^2 / 2 for x > 0
    const Real inside = larger(1.0f - fabs(near) / size, (Real)(0.0f));
    const Real outside = larger(1.0f - far / size, (Real)(0.0f));
    const Real beyond_near = near < 0.0f ? 1.0f - 0.5f * inside * inside : 0.5f * inside * inside;
    const Real height = larger(1.0f - distance / size, (Real)(0.0f)) / size;
    return height > 0.0f ? height / (beyond_near - 0.5f * outside * outside) : (Real)(0.0f);
  }
  const Real unit = (Real)(0.70710678f / size);
  const Real height = 0.39894228f / size * exp(-0.5f * distance * distance / (size * size));
  return height > 0.0f ? 2.0f * height / (erfc(near * unit) - erfc(far * unit)) : (Real)(0.0f);
}

// Moves a position on the film, in pixels, by an offset sampled from the filter. Returns the weight of the pixel in
// which it then is: the density of the filter at the centre of that pixel, divided by the probability of the pixel.
static inline Real filter_splat(const Scene* scene, CameraSample sample, Real* x, Real* y) {
  const Real from_x = *x, from_y = *y;
  *x += sample.x - 0.5f;
  *y += sample.y - 0.5f;
  return filter_ratio(scene, fabs(floor(*x) + 0.5f - from_x)) * filter_ratio(scene, fabs(floor(*y) + 0.5f - from_y));
}

// The pixel of the point (x, y) of the film, [0, 1]^2, y downwards.
static inline FilmPoint film_point(const Scene* scene, Real x, Real y, CameraSample sample, Mask in_front,
                                   Real density) {
  const __global CameraRecord* camera = scene->camera;
  const float width = (float)camera->width, height = (float)camera->height;
  Real across = x * width, down = y * height;
  FilmPoint point;
  point.share = HAS_FILTER ? filter_splat(scene, sample, &across, &down) : (Real)(1.0f);
  // Floor, not a cast: a cast would include light from outside the left and upper borders.
  const Real column = floor(across), row = floor(down);
  point.seen = in_front & (column >= 0.0f) & (column < width) & (row >= 0.0f) & (row < height);
  const Int first = (Int)(0);
  point.pixel = (point.seen ? to_int(row) : first) * camera->width + (point.seen ? to_int(column) : first);
  point.density = density;
  return point;
}

// The unit direction `from_eye` as a pinhole or a point of the lens sees it.
static inline FilmPoint camera_sees(const Scene* scene, Vec3 from_eye, CameraSample sample) {
  const __global CameraRecord* camera = scene->camera;
  const Vec3 left = broadcast_vec(camera->left), up = broadcast_vec(camera->up);
  const Real cosine = vec_dot(from_eye, broadcast_vec(camera->forward));
  Real x = 0.5f - 0.5f * vec_dot(from_eye, left) / (cosine * vec_dot(left, left)) - camera->principal_x;
  Real y = 0.5f - 0.5f * vec_dot(from_eye, up) / (cosine * vec_dot(up, up)) - camera->principal_y;
  if (HAS_LENS) {
    x -= 0.5f * camera->inv_focus_distance * sample.lens_x;
    y -= 0.5f * camera->inv_focus_distance * sample.lens_y;
  }
  return film_point(scene, x, y, sample, cosine > 0.0f, film_density(scene, cosine));
}

// A position as the camera sees it: the eye point, the direction, and the position on the film.
typedef struct {
  Vec3 eye, from_camera;
  Real distance2; // converts the density per solid angle to one per area; 1 for parallel rays
  FilmPoint film;
} View;

static inline View parallel_view(const Scene* scene, Vec3 position, CameraSample sample) {
  const __global CameraRecord* camera = scene->camera;
  const Vec3 left = broadcast_vec(camera->left), up = broadcast_vec(camera->up);
  const Vec3 to_position = vec_sub(position, broadcast_vec(camera->position));
  View view;
  view.from_camera = broadcast_vec(camera->forward);
  const Real depth = vec_dot(to_position, view.from_camera);
  view.eye = vec_along(position, -depth, view.from_camera);
  view.distance2 = (Real)(1.0f);
  const Real x = 0.5f - 0.5f * vec_dot(to_position, left) / vec_dot(left, left) - camera->principal_x;
  const Real y = 0.5f - 0.5f * vec_dot(to_position, up) / vec_dot(up, up) - camera->principal_y;
  view.film = film_point(scene, x, y, sample, depth > 0.0f, film_density(scene, (Real)(1.0f)));
  return view;
}

static inline View view_of(const Scene* scene, Vec3 position, CameraSample sample) {
  if (HAS_ORTHOGRAPHIC) return parallel_view(scene, position, sample);
  View view;
  view.eye = lens_position(scene, sample);
  const Vec3 to_position = vec_sub(position, view.eye);
  view.distance2 = vec_dot(to_position, to_position);
  view.from_camera = vec_scale(1.0f / sqrt(view.distance2), to_position);
  view.film = camera_sees(scene, view.from_camera, sample);
  return view;
}

static inline FilmPoint select_film(Mask m, FilmPoint yes, FilmPoint no) {
  FilmPoint point;
  point.seen = (m & yes.seen) | ((!m) & no.seen);
  point.pixel = m ? yes.pixel : no.pixel;
  point.density = m ? yes.density : no.density;
  point.share = m ? yes.share : no.share;
  return point;
}

#endif
