// A queue of shadow rays, which wait until every lane has one, so that no lane is idle while they are traced. Each has
// a contribution, which is added if the ray is unoccluded.
#ifndef PHLUX_SHADOW_QUEUE_CL
#define PHLUX_SHADOW_QUEUE_CL

#include "transport/contributions.cl"
#include "transport/lane_records.h"
#include "transport/masks.cl"

typedef struct {
  Ray ray;
  Real distance;   // up to which the ray must be unoccluded
  Vec3 value;      // of the contribution; without RECORD_TECHNIQUES it includes the weight
  Int path, pixel; // pixel: its complement if it is the path's own pixel
  Real weight;
  Int technique;
} ShadowRay;
#define SHADOW_FIELDS(VECTOR, NUMBER, INTEGER, UNSIGNED)                                                               \
  VECTOR(ray.origin) VECTOR(ray.direction) NUMBER(distance) VECTOR(value) INTEGER(path) INTEGER(pixel)
#define SHADOW_FIELDS_OF_TECHNIQUES(VECTOR, NUMBER, INTEGER, UNSIGNED) NUMBER(weight) INTEGER(technique)
#define SHADOW_WORDS                                                                                                   \
  (RECORD_WORDS_OF(SHADOW_FIELDS) + (RECORD_TECHNIQUES ? RECORD_WORDS_OF(SHADOW_FIELDS_OF_TECHNIQUES) : 0))

typedef struct {
  LaneWords words[SHADOW_WORDS];
  int count; // < LANES between calls
  uint traced;
} ShadowQueue;

static inline void empty_shadow_queue(ShadowQueue* queue) {
  queue->count = 0;
  queue->traced = 0;
}

#define PUT_SHADOW_VECTOR(member) put_vector(queue->words, &word, at, shadow.member, m);
#define PUT_SHADOW_NUMBER(member) put_number(queue->words, &word, at, shadow.member, m);
#define PUT_SHADOW_INTEGER(member) put_number(queue->words, &word, at, carry_int(shadow.member), m);
static inline void put_shadow_rays(ShadowQueue* queue, int at, ShadowRay shadow, Mask m) {
  int word = 0;
  SHADOW_FIELDS(PUT_SHADOW_VECTOR, PUT_SHADOW_NUMBER, PUT_SHADOW_INTEGER, PUT_SHADOW_INTEGER)
  if (RECORD_TECHNIQUES) {
    SHADOW_FIELDS_OF_TECHNIQUES(PUT_SHADOW_VECTOR, PUT_SHADOW_NUMBER, PUT_SHADOW_INTEGER, PUT_SHADOW_INTEGER)
  }
}

#define SHADOW_VECTOR(member) shadow.member = vector_at(queue->words, &word, at);
#define SHADOW_NUMBER(member) shadow.member = number_at(queue->words, &word, at);
#define SHADOW_INTEGER(member) shadow.member = carried_int(number_at(queue->words, &word, at));
// Reads the rays from `at` on.
static inline ShadowRay shadow_rays_at(const ShadowQueue* queue, int at) {
  ShadowRay shadow;
  int word = 0;
  SHADOW_FIELDS(SHADOW_VECTOR, SHADOW_NUMBER, SHADOW_INTEGER, SHADOW_INTEGER)
  shadow.weight = (Real)(1.0f);
  shadow.technique = (Int)(0);
  if (RECORD_TECHNIQUES) {
    SHADOW_FIELDS_OF_TECHNIQUES(SHADOW_VECTOR, SHADOW_NUMBER, SHADOW_INTEGER, SHADOW_INTEGER)
  }
  return shadow;
}

// Traces the first rays of the queue, at most one per lane, and adds the contributions of those that are unoccluded.
// With RECORD_TECHNIQUES an occluded ray adds 0, so that the host counts the rays of each technique.
static inline void trace_shadow_rays(const Scene* scene, ShadowQueue* queue, Output* output) {
  const Mask waiting = LANE_NUMBERS < (Int)(queue->count);
  ShadowRay shadow = shadow_rays_at(queue, 0);
  const Mask unoccluded = waiting & !shadow_ray_blocked(scene, shadow.ray, shadow.distance, &shadow.value, waiting);
  Contribution c;
  c.path = shadow.path;
  c.own = shadow.pixel < 0;
  c.pixel = c.own ? ~shadow.pixel : shadow.pixel;
  c.value = shadow.value;
  c.weight = shadow.weight;
  c.technique = shadow.technique;
  if (RECORD_TECHNIQUES) c.value = vec_select(unoccluded, c.value, vec_all((Real)(0.0f)));
  const Mask added = RECORD_TECHNIQUES ? waiting : unoccluded;
  if (any_lane(added)) add_contribution(output, c, added);
  queue->traced += (uint)min(queue->count, LANES);
}

// Adds the contributions of the lanes of m if `ray` is unoccluded before `distance`.
static inline void add_if_unoccluded(const Scene* scene, ShadowQueue* queue, Output* output, Ray ray, Real distance,
                                     Contribution c, Mask m) {
  ShadowRay shadow;
  shadow.ray = ray;
  shadow.distance = distance;
  shadow.value = RECORD_TECHNIQUES ? c.value : vec_scale(c.weight, c.value);
  shadow.path = c.path;
  shadow.pixel = c.own ? ~c.pixel : c.pixel;
  shadow.weight = c.weight;
  shadow.technique = c.technique;
  put_shadow_rays(queue, queue->count, shadow, m);
  queue->count += count_lanes(m);
  if (queue->count < LANES) return;
  trace_shadow_rays(scene, queue, output);
  put_shadow_rays(queue, 0, shadow_rays_at(queue, LANES), ALL_LANES);
  queue->count -= LANES;
}

static inline void trace_last_shadow_rays(const Scene* scene, ShadowQueue* queue, Output* output) {
  if (queue->count > 0) trace_shadow_rays(scene, queue, output);
  queue->count = 0;
}

#endif
