// Constants. Those in REAL() have the precision of a Real.
#ifndef PHLUX_CONSTANTS_H
#define PHLUX_CONSTANTS_H

#include "lanes/lanes.h"

#define PI REAL(3.14159265358979324)
#define INV_PI REAL(0.318309886183790672)
#define ONE_MINUS_EPSILON 0x1.fffffep-1f // the largest float below 1

#endif
