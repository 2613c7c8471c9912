// What light paths and bidirectional paths bring to the film. A bidirectional path adds to its own pixel at once; what
// it sends to others is recorded. The records of a batch are written in order and the host sums them in order: the same
// seed gives the same image, without atomics.
#ifndef PHLUX_CONTRIBUTIONS_CL
#define PHLUX_CONTRIBUTIONS_CL

#include "lanes.h"
#include "scene_data.h"

// Light that `path` brings to `pixel`: `value` x `weight`, made by s light and t eye vertices (technique, s << 16 | t).
// A pixel's radiance is the sum of them over all paths / the number of paths per pixel.
typedef struct {
  Int path, pixel, technique;
  Mask own; // the pixel is the path's own
  Vec3 value;
  Real weight;
} Contribution;

typedef struct {
  __global float* records; // arrays of `capacity` words each, see RecordWords
  int capacity;
  int count; // records so far, those beyond the capacity included: the host then makes more room and tries again
  Uint nonfinite;
#ifdef PHLUX_BIDIR
  __global float* radiance; // four words for each path: what it brought to its own pixel
#endif
} Output;

// Whether a contribution is worth a shadow ray: not black. One that is not a number is, so that it gets counted.
static inline Mask brings_light(Vec3 value) { return !(vec_sum(value) <= 0.0f); }

static inline void append_record(Output* output, Contribution c, Mask m) {
  if (output->count + LANES <= output->capacity) {
    __global float* words = output->records + output->count;
    __global int* ints = (__global int*)words;
    const int stride = output->capacity;
    store_ints(ints + RECORD_PIXEL * stride, pack_int_lanes(m, c.pixel));
    store_ints(ints + RECORD_PATH * stride, pack_int_lanes(m, c.path));
    store_reals(words + RECORD_VALUE * stride, pack_lanes(m, c.value.x));
    store_reals(words + (RECORD_VALUE + 1) * stride, pack_lanes(m, c.value.y));
    store_reals(words + (RECORD_VALUE + 2) * stride, pack_lanes(m, c.value.z));
#ifdef PHLUX_TECHNIQUES
    store_reals(words + RECORD_WEIGHT * stride, pack_lanes(m, c.weight));
    store_ints(ints + RECORD_TECHNIQUE * stride, pack_int_lanes(m, c.own ? ~c.technique : c.technique));
#endif
  }
  output->count += count_lanes(m);
}

static inline void add_contribution(Output* output, Contribution c, Mask m) {
  const Vec3 weighted = vec_scale(c.weight, c.value);
  const Real total = vec_sum(weighted);
  const Mask finite = total - total == 0.0f;
  output->nonfinite += (m & !finite) ? (Uint)(1u) : (Uint)(0u);
  const Mask counts = m & finite;
#ifdef PHLUX_BIDIR
  if (any_lane(counts & c.own)) add_vec(output->radiance, c.path, weighted, counts & c.own);
#endif
#ifdef PHLUX_TECHNIQUES
  const Mask recorded = counts;
#else
  const Mask recorded = counts & !c.own;
  c.value = weighted;
#endif
  if (any_lane(recorded)) append_record(output, c, recorded);
}

#endif
