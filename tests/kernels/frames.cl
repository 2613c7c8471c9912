#include "math/frames.h"

__kernel void about(__global const Vec3* z, __global Frame* frame) {
  const size_t i = get_global_id(0);
  frame[i] = frame_about(z[i]);
}

__kernel void along(__global const Vec3* z, __global const Vec3* tangent, __global Frame* frame) {
  const size_t i = get_global_id(0);
  frame[i] = frame_along(z[i], tangent[i]);
}

__kernel void there_and_back(__global const Vec3* z, __global const Vec3* v, __global Vec3* inside, __global Vec3* back) {
  const size_t i = get_global_id(0);
  const Frame frame = frame_about(z[i]);
  inside[i] = to_frame(frame, v[i]);
  back[i] = from_frame(frame, inside[i]);
}
