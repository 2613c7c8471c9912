// Shadow rays wait until every lane has one, so that none idles while they are traced. What waits is a contribution and
// the ray that must be free for it to count.
#ifndef PHLUX_SHADOW_QUEUE_CL
#define PHLUX_SHADOW_QUEUE_CL

#include "transport/contributions.cl"
#include "scene/traverse.cl"

typedef struct {
  Scalar origin[3][2 * LANES], direction[3][2 * LANES], distance[2 * LANES];
  Scalar value[3][2 * LANES];
  int path[2 * LANES], pixel[2 * LANES]; // its complement where the contribution is to the path's own pixel
  Scalar weight[2 * LANES]; // RECORD_TECHNIQUES: else it is in the value
  int technique[2 * LANES]; // RECORD_TECHNIQUES
  int count; // < LANES between calls
  uint traced;
} ShadowQueue;

static inline void vec_to_arrays(Vec3 v, Scalar (*arrays)[2 * LANES], int at) {
  lanes_to_array(v.x, arrays[0] + at);
  lanes_to_array(v.y, arrays[1] + at);
  lanes_to_array(v.z, arrays[2] + at);
}
static inline Vec3 vec_from_arrays(const Scalar (*arrays)[2 * LANES], int at) {
  return vec3(lanes_from_array(arrays[0] + at), lanes_from_array(arrays[1] + at), lanes_from_array(arrays[2] + at));
}

// The entries from `at` on.
static inline Ray waiting_ray(const ShadowQueue* queue, int at) {
  Ray ray;
  ray.origin = vec_from_arrays(queue->origin, at);
  ray.direction = vec_from_arrays(queue->direction, at);
  return ray;
}
static inline Contribution waiting_contribution(const ShadowQueue* queue, int at) {
  Contribution c;
  c.value = vec_from_arrays(queue->value, at);
  c.path = int_lanes_from_array(queue->path + at);
  const Int pixel = int_lanes_from_array(queue->pixel + at);
  c.own = pixel < 0;
  c.pixel = c.own ? ~pixel : pixel;
  c.weight = RECORD_TECHNIQUES ? lanes_from_array(queue->weight + at) : (Real)(1.0f);
  c.technique = RECORD_TECHNIQUES ? int_lanes_from_array(queue->technique + at) : (Int)(0);
  return c;
}
static inline void put_waiting(ShadowQueue* queue, int at, Ray ray, Real distance, Contribution c, Mask m) {
  vec_to_arrays(pack_vec(m, ray.origin), queue->origin, at);
  vec_to_arrays(pack_vec(m, ray.direction), queue->direction, at);
  lanes_to_array(pack_lanes(m, distance), queue->distance + at);
  int_lanes_to_array(pack_int_lanes(m, c.path), queue->path + at);
  int_lanes_to_array(pack_int_lanes(m, c.own ? ~c.pixel : c.pixel), queue->pixel + at);
  if (RECORD_TECHNIQUES) {
    vec_to_arrays(pack_vec(m, c.value), queue->value, at);
    lanes_to_array(pack_lanes(m, c.weight), queue->weight + at);
    int_lanes_to_array(pack_int_lanes(m, c.technique), queue->technique + at);
  } else {
    vec_to_arrays(pack_vec(m, vec_scale(c.weight, c.value)), queue->value, at);
  }
}

// Traces the first entries: a ray for each lane, or what is left.
static inline void trace_waiting(const Scene* scene, ShadowQueue* queue, Output* output) {
  const Mask waiting = LANE_NUMBERS < (Int)(queue->count);
  const Real distance = lanes_from_array(queue->distance);
  const Mask free = waiting & !scene_occluded(scene, waiting_ray(queue, 0), distance, waiting);
  if (any_lane(free)) add_contribution(output, waiting_contribution(queue, 0), free);
  queue->traced += (uint)min(queue->count, LANES);
}

// Lets the contributions of the lanes of m count if nothing is met before `distance` along `ray`.
static inline void add_if_free(const Scene* scene, ShadowQueue* queue, Output* output, Ray ray, Real distance,
                               Contribution c, Mask m) {
  put_waiting(queue, queue->count, ray, distance, c, m);
  queue->count += count_lanes(m);
  if (queue->count < LANES) return;
  trace_waiting(scene, queue, output);
  put_waiting(queue, 0, waiting_ray(queue, LANES), lanes_from_array(queue->distance + LANES),
              waiting_contribution(queue, LANES), ALL_LANES);
  queue->count -= LANES;
}

static inline void trace_last(const Scene* scene, ShadowQueue* queue, Output* output) {
  if (queue->count > 0) trace_waiting(scene, queue, output);
  queue->count = 0;
}

#endif
