// Batches: the paths of so many jobs, which one work-item makes before it goes on to others. Its lanes take the paths
// in order, whichever lane is idle. What a batch yields does not depend on how work was cut into launches.
#ifndef PHLUX_BATCH_CL
#define PHLUX_BATCH_CL

#include "lanes/lanes.h"
#include "transport/launch.h"
#include "math/random.h"

typedef struct {
  int job, jobs;    // its first job of the launch, and how many
  int path_count;   // paths are numbered job by job
  int next;         // path that is taken next
  int first_pixel;  // of the first job
  int first_sample; // of the first job
} Batch;

static inline int batch_count(JobList list, int batch_jobs) { return (list.job_count + batch_jobs - 1) / batch_jobs; }

static inline Batch batch_at(JobList list, int batch_jobs, int index) {
  Batch batch;
  batch.job = index * batch_jobs;
  batch.jobs = min(batch_jobs, list.job_count - batch.job);
  batch.path_count = batch.jobs * list.block_samples;
  batch.next = 0;
  const int block = (list.first_pixel + batch.job) / list.pixel_count;
  batch.first_pixel = list.first_pixel + batch.job - block * list.pixel_count;
  batch.first_sample = list.first_sample + block * list.block_samples;
  return batch;
}

// Gives the lanes of `idle` the paths that are next, in lane order; returns the lanes that got one.
static inline Mask take_paths(Batch* batch, Int* path, Mask idle) {
  const Int number = batch->next + rank_lanes(idle);
  const Mask taken = idle & (number < batch->path_count);
  *path = taken ? number : *path;
  batch->next = min(batch->next + count_lanes(idle), batch->path_count);
  return taken;
}

// floor(a / b) for 0 <= a < 2^22 and b > 0: the half keeps the quotient of floats off the whole numbers.
static inline Int quotient(Int a, int b) { return to_int((to_real(a) + 0.5f) / (float)b); }

// The pixel and sample of a path of the batch.
static inline void find_path(JobList list, const Batch* batch, Int path, RandomSequence* sequence) {
  const Int job = quotient(path, list.block_samples);
  // Pixels past the image's end belong to later blocks; a small image may end several times in a batch.
  const Int beyond = batch->first_pixel - list.pixel_count + job;
  const Int ends = beyond >= 0 ? 1 + quotient(max(beyond, (Int)(0)), list.pixel_count) : (Int)(0);
  const Int sample = path - job * list.block_samples;
  sequence->pixel = int_to_uint(batch->first_pixel + job - ends * list.pixel_count);
  sequence->sample = int_to_uint(batch->first_sample + ends * list.block_samples + sample);
}

#endif
