// Subpaths that wait to be walked. They are made for all lanes at once and taken by lanes that fall idle, last first.
#ifndef PHLUX_STARTS_CL
#define PHLUX_STARTS_CL

#include "transport/batch.cl"
#include "transport/walk.cl"

#define START_WORDS (IS_BIDIR ? 15 : 12)

typedef struct {
  Scalar words[START_WORDS][2 * LANES];
  int count;
} Starts;

static inline Starts no_starts(void) {
  Starts starts;
  starts.count = 0;
  return starts;
}

// Whether more are wanted for so many idle lanes, and the batch has more.
static inline int wants_starts(const Starts* starts, const Batch* batch, int idle) {
  return starts->count < min(idle, LANES) && batch->next < batch->path_count;
}

static inline void put_start_words(Starts* starts, int word, Vec3 v, Mask m) {
  lanes_to_array(pack_lanes(m, v.x), starts->words[word] + starts->count);
  lanes_to_array(pack_lanes(m, v.y), starts->words[word + 1] + starts->count);
  lanes_to_array(pack_lanes(m, v.z), starts->words[word + 2] + starts->count);
}
static inline Vec3 take_start_words(const Starts* starts, int word, Vec3 old, Mask m) {
  return vec3(unpack_lanes(m, lanes_from_array(starts->words[word] + starts->count), old.x),
              unpack_lanes(m, lanes_from_array(starts->words[word + 1] + starts->count), old.y),
              unpack_lanes(m, lanes_from_array(starts->words[word + 2] + starts->count), old.z));
}
static inline Vec3 start_numbers(const Walk* walk) {
  return vec3(carry_int(walk->path), carry_int(uint_to_int(walk->sequence.pixel)),
              carry_int(uint_to_int(walk->sequence.sample)));
}

// Puts the lanes of m of `walk`, no edges long, among those that wait.
static inline void put_starts(Starts* starts, const Walk* walk, Mask m) {
  put_start_words(starts, 0, walk->ray.origin, m);
  put_start_words(starts, 3, walk->ray.direction, m);
  put_start_words(starts, 6, walk->throughput, m);
  put_start_words(starts, 9, start_numbers(walk), m);
  if (IS_BIDIR)
    put_start_words(starts, 12, vec3(walk->ratios.edge, walk->light_cosine, carry_int(walk->light)), m);
  starts->count += count_lanes(m);
}

// Starts as many lanes of `idle` as there are subpaths waiting; returns those.
static inline Mask take_starts(Starts* starts, Walk* walk, Mask idle) {
  const int taken = min(starts->count, count_lanes(idle));
  const Mask starting = idle & (rank_lanes(idle) < taken);
  starts->count -= taken;
  walk->ray.origin = take_start_words(starts, 0, walk->ray.origin, starting);
  walk->ray.direction = take_start_words(starts, 3, walk->ray.direction, starting);
  walk->throughput = take_start_words(starts, 6, walk->throughput, starting);
  const Vec3 numbers = take_start_words(starts, 9, start_numbers(walk), starting);
  walk->path = carried_int(numbers.x);
  walk->sequence.pixel = int_to_uint(carried_int(numbers.y));
  walk->sequence.sample = int_to_uint(carried_int(numbers.z));
  walk->edges = starting ? (Int)(0) : walk->edges;
  if (IS_BIDIR) {
    const Vec3 old = vec3(walk->ratios.edge, walk->light_cosine, carry_int(walk->light));
    const Vec3 more = take_start_words(starts, 12, old, starting);
    walk->ratios.edge = more.x;
    walk->ratios.rest = starting ? (Real)(0.0f) : walk->ratios.rest;
    walk->light_cosine = more.y;
    walk->light = carried_int(more.z);
  }
  return starting;
}

#endif
