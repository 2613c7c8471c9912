// The work of a launch (host/render/schedule.h): jobs, each for one pixel and one block of its samples. Jobs are
// ordered by block, then by pixel.
#ifndef PHLUX_LAUNCH_H
#define PHLUX_LAUNCH_H

typedef struct {
  int pixel_count; // of the image
  int first_pixel; // pixel of job 0
  int job_count;
  int first_sample, block_samples; // block b has samples first_sample + b block_samples onwards
} JobList;

#endif
