// The incident light of `phlux bench sampling`; the host integrates the same functions (bench/sampling/radiance.h).
// Each kind is scaled so that its integral over the hemisphere is 2 pi, as that of the radiance 1, if no part of it is
// below the horizon.
#ifndef PHLUX_SAMPLING_RADIANCE_H
#define PHLUX_SAMPLING_RADIANCE_H

// Radiance 1 from everywhere.
#define RADIANCE_CONSTANT 0

// A disk about the mirror image of the fixed direction, of 5 degrees' radius: where |w - r|^2 < (2 sin(2.5 degrees))^2
// the radiance is 1 / (1 - cos(5 degrees)), elsewhere 0.
#define RADIANCE_MIRROR_DISK 1
#define MIRROR_DISK_DEGREES 5.0
#define MIRROR_DISK_CHORD2 7.6106038e-03f
#define MIRROR_DISK_RADIANCE 262.79123f

// A sky that is 21 times as bright at the horizon as overhead: 1 / (ln(21) (cos(theta) + 1/20)).
#define RADIANCE_HORIZON_SKY 2
#define HORIZON_SKY_SCALE 0.32845877f
#define HORIZON_SKY_HEIGHT 0.05f

#endif
