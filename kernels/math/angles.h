// Cosine and sine of fractions of a turn.
#ifndef PHLUX_ANGLES_H
#define PHLUX_ANGLES_H

#include "lanes/lanes.h"

// Cosine and sine of 2 pi turns, for turns in [0, 1]; errors are at most 2 ulp of the larger. The polynomials have the
// least maximal relative error within an eighth of a turn of the nearest multiple of a quarter.
static inline void cos_sin_turns(Real turns, Real* cosine, Real* sine) {
#ifdef PHLUX_DOUBLE
  *cosine = cospi(2.0 * turns);
  *sine = sinpi(2.0 * turns);
#else
  const Real quarters = rint(4.0f * turns);
  const Real r = fma((Real)(4.0f), turns, -quarters);
  const Real r2 = r * r;
  const Real s = r * fma(r2, fma(r2, fma(r2, (Real)(-4.601663e-03f), (Real)(7.968003e-02f)), (Real)(-6.4596346e-01f)),
                         (Real)(1.57079632f));
  const Real c =
      fma(r2,
          fma(r2, fma(r2, fma(r2, (Real)(9.0336298e-04f), (Real)(-2.08599360e-02f)), (Real)(2.53669183e-01f)),
              (Real)(-1.23370054f)),
          (Real)(1.0f));
  const Int quadrant = to_int(quarters);
  const Mask odd = (quadrant & 1) != 0;
  const Real cosine_here = odd ? s : c, sine_here = odd ? c : s;
  *cosine = ((quadrant + 1) & 2) != 0 ? -cosine_here : cosine_here;
  *sine = (quadrant & 2) != 0 ? -sine_here : sine_here;
#endif
}

#endif
