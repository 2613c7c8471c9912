// Lanes: the arithmetic types of all other kernel files. A work-item traces WIDTH paths together: 4, 8 or 16 on a CPU,
// in its vector registers, and 1 on a GPU, where each type is a scalar. Only this folder uses WIDTH.
//
// Operators and the built-in functions of OpenCL C can be used with Real, Int and Uint. A comparison gives a Mask;
// masks are combined by & | ! and used in ?: (for a Real, an Int or a Uint) or vec_select (for the Vec3 of vectors.h).
// The value of a lane whose mask is off is undefined and may be NaN: select results, never multiply them by 0.
//
// PHLUX_DOUBLE makes Real a double, only with WIDTH 1: comparisons of double vectors give masks of long, which cannot
// select Ints. Only this folder and math/angles.h depend on it. The tables of shapes then contain doubles. Camera,
// materials and lights are floats in both precisions, and so are sums and splats that are sent to the host, which are
// rounded once, by a relative error of 2^-24.
#ifndef PHLUX_LANES_H
#define PHLUX_LANES_H

#include "lanes/across.h"
#include "lanes/memory.h"
#include "lanes/types.h"

#endif
