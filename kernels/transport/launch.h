// The work of a launch (host/render/schedule.h): jobs, each for one pixel and one block of its samples. Jobs are
// ordered by block, then by pixel.
#ifndef PHLUX_LAUNCH_H
#define PHLUX_LAUNCH_H

#include "math/random.h"

typedef struct {
  int pixel_count; // of the image
  int first_pixel; // pixel of job 0
  int job_count;
  int first_sample, block_samples; // block b has samples first_sample + b block_samples onwards
} JobList;

// Limits of path lengths, in edges.
typedef struct {
  int longest;
  int roulette; // first edge at which roulette decides
} PathLimits;

// The parameters of a kernel for a launch, and statements that copy them to `list`, `limits` and `sets`. `counters`
// receives two numbers of each work-item: rays and shadow rays.
#define LAUNCH_PARAMETERS                                                                                              \
  int pixel_count, int first_pixel, int job_count, int first_sample, int block_samples, uint2 seed, uint2 point_sets,  \
      int max_edges, int roulette_edges, __global uint *counters
#define LAUNCH_FROM_PARAMETERS                                                                                         \
  const JobList list = {pixel_count, first_pixel, job_count, first_sample, block_samples};                             \
  const PathLimits limits = {max_edges, roulette_edges};                                                               \
  const PointSets sets = {point_sets.x, point_sets.y};

#endif
