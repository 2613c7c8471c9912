#include "math/angles.h"
#include "lanes/lanes.h"

__kernel void turns(__global const Real* turns, __global Real* cosine, __global Real* sine) {
  const size_t i = get_global_id(0);
  Real c, s;
  cos_sin_turns(turns[i], &c, &s);
  cosine[i] = c;
  sine[i] = s;
}
