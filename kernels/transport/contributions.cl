// Contributions of light paths and bidirectional paths to the film. A bidirectional path adds to its own pixel
// directly; splats to other pixels are written as records. The order of the records of a batch is fixed, and the host
// adds them in that order, so that the same seed gives the same image, without atomics.
#ifndef PHLUX_CONTRIBUTIONS_CL
#define PHLUX_CONTRIBUTIONS_CL

#include "math/vectors.h"
#include "scene/scene_data.h"

// A contribution of `path` to `pixel`: value x weight, by the technique of s light and t eye vertices (s << 16 | t).
// The radiance of a pixel is the sum of its contributions over all paths, divided by the number of paths per pixel.
typedef struct {
  Int path, pixel, technique;
  Mask own; // the pixel is that of the path itself
  Vec3 value;
  Real weight;
} Contribution;

typedef struct {
  __global float* records; // arrays of `capacity` words each, see RecordWords
  int capacity;
  int count; // records so far, also those beyond the capacity: the host then repeats the launch with more room
  __global float* radiance; // bidir: four words for each path, its contributions to its own pixel
} Output;

// Selects the records of batch `index` for output.
static inline void output_to(Output* output, __global float* records, int index, int record_words, int capacity) {
  output->records = records + (size_t)index * (size_t)record_words * (size_t)capacity;
  output->capacity = capacity;
  output->count = 0;
}

// Lanes whose contribution needs a shadow ray: those that are not black. NaN is traced too, so that it is counted.
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
    if (RECORD_TECHNIQUES) {
      store_reals(words + RECORD_WEIGHT * stride, pack_lanes(m, c.weight));
      store_ints(ints + RECORD_TECHNIQUE * stride, pack_int_lanes(m, c.own ? ~c.technique : c.technique));
    }
  }
  output->count += count_lanes(m);
}

// Contributions that are not finite are recorded too: the host counts them and reports their paths.
static inline void add_contribution(Output* output, Contribution c, Mask m) {
  Mask recorded = m;
  const Vec3 weighted = vec_scale(c.weight, c.value);
  if (IS_BIDIR) {
    const Real total = vec_sum(weighted);
    const Mask to_own = m & c.own & (total - total == 0.0f);
    if (any_lane(to_own)) add_vec(output->radiance, c.path, weighted, to_own);
    if (!RECORD_TECHNIQUES) recorded &= !to_own;
  }
  if (!RECORD_TECHNIQUES) c.value = weighted;
  if (any_lane(recorded)) append_record(output, c, recorded);
}

// Writes the sums over the samples of each job, for `jobs` jobs from `first_job` of the launch on.
static inline void sum_jobs(const Output* output, int first_job, int jobs, int block_samples, __global float* sums) {
  for (int job = 0; job < jobs; ++job) {
    float4 sum = (float4)(0.0f), sum_of_squares = (float4)(0.0f);
    float clamped = 0.0f;
    for (int sample = 0; sample < block_samples; ++sample) {
      float4 radiance = vload4((size_t)(job * block_samples + sample), output->radiance);
      if (HAS_CLAMP) {
        const float scale = CLAMP_RADIANCE / fmax(CLAMP_RADIANCE, fmax(radiance.x, fmax(radiance.y, radiance.z)));
        clamped += (1.0f - scale) * (radiance.x + radiance.y + radiance.z);
        radiance *= scale;
      }
      sum += radiance;
      sum_of_squares += radiance * radiance;
    }
    __global float* mine = sums + (first_job + job) * SUM_WORDS;
    vstore3(sum.xyz, 0, mine + SUM_RADIANCE);
    vstore3(sum_of_squares.xyz, 0, mine + SUM_SQUARES);
    mine[SUM_NONFINITE] = 0.0f;
    mine[SUM_CLAMPED] = clamped;
  }
}

#endif
