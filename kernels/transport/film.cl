// The film in path tracing: jobs, whose sums are sent to the host. Lane l of a launch takes the jobs l, l + stride,
// ..., so that a lane whose path has ended begins the next path at once.
#ifndef PHLUX_FILM_CL
#define PHLUX_FILM_CL

#include "math/vectors.h"
#include "scene/scene_data.h"
#include "transport/launch.h"

// The current job of each lane.
typedef struct {
  Int job, pixel, block;
  Int samples; // done
  Vec3 sum, sum_of_squares;
  Uint nonfinite; // samples that were not finite, which count as black
  Real clamped;   // radiance that CLAMP_RADIANCE removed
} Job;

static inline int job_stride(void) { return (int)get_global_size(0) * LANES; }

static inline Job first_job(JobList list) {
  Job job;
  job.job = (int)get_global_id(0) * LANES + LANE_NUMBERS;
  job.block = (list.first_pixel + job.job) / list.pixel_count;
  job.pixel = list.first_pixel + job.job - job.block * list.pixel_count;
  job.samples = (Int)(0);
  job.sum = job.sum_of_squares = vec_all((Real)(0.0f));
  job.nonfinite = (Uint)(0u);
  job.clamped = (Real)(0.0f);
  return job;
}

static inline Mask jobs_left(JobList list, Job job) { return job.job < list.job_count; }

// The number of the next sample.
static inline Int sample_number(JobList list, Job job) {
  return list.first_sample + job.block * list.block_samples + job.samples;
}

// Writes the sums of the lanes of `complete` and moves them to their next job.
static inline void hand_over(JobList list, Job* job, __global float* sums, Mask complete) {
  const Int slot = job->job * SUM_WORDS;
  scatter_vec(sums + SUM_RADIANCE, slot, job->sum, complete);
  scatter_vec(sums + SUM_SQUARES, slot, job->sum_of_squares, complete);
  scatter_real(sums + SUM_NONFINITE, slot, uint_to_real(job->nonfinite), complete);
  job->sum = vec_select(complete, vec_all((Real)(0.0f)), job->sum);
  job->sum_of_squares = vec_select(complete, vec_all((Real)(0.0f)), job->sum_of_squares);
  job->nonfinite = complete ? (Uint)(0u) : job->nonfinite;
  if (HAS_CLAMP) {
    scatter_real(sums + SUM_CLAMPED, slot, job->clamped, complete);
    job->clamped = complete ? (Real)(0.0f) : job->clamped;
  }
  job->samples = complete ? (Int)(0) : job->samples;
  const int stride = job_stride();
  const Int next_pixel = job->pixel + stride % list.pixel_count;
  const Mask wraps = next_pixel >= list.pixel_count;
  const Int next_block = job->block + stride / list.pixel_count;
  job->pixel = complete ? (wraps ? next_pixel - list.pixel_count : next_pixel) : job->pixel;
  job->block = complete ? (wraps ? next_block + 1 : next_block) : job->block;
  job->job += complete ? (Int)(stride) : (Int)(0);
}

// Adds one finished sample in the lanes of `ended`.
static inline void add_sample(JobList list, Job* job, Vec3 radiance, __global float* sums, Mask ended) {
  const Real total = radiance.x + radiance.y + radiance.z;
  const Mask finite = total - total == 0.0f;
  const Mask counts = ended & finite;
  job->nonfinite += (ended & !finite) ? (Uint)(1u) : (Uint)(0u);
  if (HAS_CLAMP) {
    const Real scale = CLAMP_RADIANCE / larger(vec_max(radiance), (Real)(CLAMP_RADIANCE));
    job->clamped += counts ? (1.0f - scale) * total : (Real)(0.0f);
    radiance = vec_scale(scale, radiance);
  }
  job->sum = vec_select(counts, vec_add(job->sum, radiance), job->sum);
  job->sum_of_squares =
      vec_select(counts, vec_add(job->sum_of_squares, vec_mul(radiance, radiance)), job->sum_of_squares);
  job->samples += ended ? (Int)(1) : (Int)(0);
  const Mask complete = ended & (job->samples == list.block_samples);
  if (any_lane(complete)) hand_over(list, job, sums, complete);
}

#endif
