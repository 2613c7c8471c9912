// What a launch is to do (host/render/schedule.h): jobs, each one pixel and one block of its samples. Jobs count pixel
// by pixel, then block by block.
#ifndef PHLUX_LAUNCH_H
#define PHLUX_LAUNCH_H

typedef struct {
  int pixel_count; // of the image
  int first_pixel; // job 0 is of that pixel
  int job_count;
  int first_sample, block_samples; // block b has samples first_sample + b block_samples onwards
} JobList;

#endif
