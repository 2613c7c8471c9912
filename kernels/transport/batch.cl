// A batch is the paths of several jobs, which a work-item completes before it begins the next batch. Idle lanes take
// the paths in order. The results of a batch do not depend on how the work is divided into launches.
#ifndef PHLUX_BATCH_CL
#define PHLUX_BATCH_CL

#include "lanes/lanes.h"
#include "math/random.h"
#include "transport/launch.h"

typedef struct {
  int job, jobs;    // first job in the launch, and number of jobs
  int path_count;   // paths are numbered in the order of the jobs
  int next;         // next path to be taken
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

// Gives the next paths to the lanes of `idle`, in lane order; returns the lanes that got one.
static inline Mask take_paths(Batch* batch, Int* path, Mask idle) {
  const Int number = batch->next + rank_lanes(idle);
  const Mask taken = idle & (number < batch->path_count);
  *path = taken ? number : *path;
  batch->next = min(batch->next + count_lanes(idle), batch->path_count);
  return taken;
}

// The pixel and sample of a path of the batch.
static inline void find_path(JobList list, const Batch* batch, Int path, RandomSequence* sequence) {
  const Int job = quotient(path, list.block_samples);
  // Pixels beyond the end of the image belong to the next block; a batch may contain several blocks of a small image.
  const Int beyond = batch->first_pixel - list.pixel_count + job;
  const Int ends = beyond >= 0 ? 1 + quotient(max(beyond, (Int)(0)), list.pixel_count) : (Int)(0);
  const Int sample = path - job * list.block_samples;
  sequence->pixel = int_to_uint(batch->first_pixel + job - ends * list.pixel_count);
  sequence->sample = int_to_uint(batch->first_sample + ends * list.block_samples + sample);
}

#endif
