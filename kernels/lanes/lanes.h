// Lanes: the arithmetic types in which every other kernel file is written. WIDTH paths travel together in one
// work-item: 4, 8 or 16 on a CPU, whose vector registers they fill, and 1 on a GPU, where each type is a plain scalar.
// Only this folder knows WIDTH.
//
// Operators and the built-in functions of OpenCL C work on Real, Int and Uint as they are. A comparison gives a Mask;
// masks combine with & | ! and select with ?: (for a Real, an Int or a Uint) or vec_select (for vectors.h's Vec3).
// A lane whose mask is off may hold anything, NaN included: select results, never multiply them by 0.
//
// PHLUX_DOUBLE makes Real a double, at WIDTH 1 alone: comparisons of double vectors give masks of long, which no Int
// goes with. Only this folder and math/angles.h know of it. Shapes' tables are of doubles then. Camera, materials and lights stay floats,
// the same in either precision, and so do sums and splats on their way to the host: each is rounded once, to 2^-24.
#ifndef PHLUX_LANES_H
#define PHLUX_LANES_H

#include "lanes/across.h"
#include "lanes/memory.h"
#include "lanes/types.h"

#endif
