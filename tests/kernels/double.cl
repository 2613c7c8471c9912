#include "math/frames.h"

__kernel void signs_and_ints(__global const Real* x, __global const Real* sign, __global const Int* whole,
                             __global Real* product, __global Int* carried) {
  const size_t i = get_global_id(0);
  product[i] = times_sign(x[i], sign[i]);
  carried[i] = pack_int_lanes(ALL_LANES, whole[i]);
}

// Error of transforming a vector into a frame and back.
__kernel void there_and_back(__global const Vec3* direction, __global const Vec3* vector, __global Real* error) {
  const size_t i = get_global_id(0);
  const Frame frame = frame_about(vec_normalize(direction[i]));
  error[i] = vec_largest(vec_sub(from_frame(frame, to_frame(frame, vector[i])), vector[i]));
}
