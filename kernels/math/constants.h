// Constants in the precision of a Real.
#ifndef PHLUX_CONSTANTS_H
#define PHLUX_CONSTANTS_H

#include "lanes/lanes.h"

#define PI REAL(3.14159265358979324)
#define INV_PI REAL(0.318309886183790672)

#endif
