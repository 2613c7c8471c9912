// Low-discrepancy point sets in four dimensions: sets of 2^bits points, at most 2^MOST_POINT_BITS. A coordinate is a
// word whose highest bit is the first digit. A set is randomized by four uniform words, so that each point is exactly
// uniform over all words.
#ifndef PHLUX_POINT_SETS_H
#define PHLUX_POINT_SETS_H

#include "lanes/lanes.h"

#define MOST_POINT_BITS 6

typedef struct {
  Uint x, y, z, w;
} RandomWords;

// The bits of the random words that determine the scrambling: below those of the shift, so that both are independent.
#define SCRAMBLING_BITS 19

// Linear scrambling of the digits of a set: multiplies their vector, the highest bit first, by a random unit lower
// triangular matrix (Matousek 1998), which is a product of three sparse ones.
static inline Uint scramble_digits(Uint digits, Uint random) {
  const Uint masks = random << (32 - SCRAMBLING_BITS);
  digits ^= (digits >> 1) & masks;
  digits ^= (digits >> 2) & (masks << 6);
  return digits ^ ((digits >> 4) & (masks << 10));
}

// Point `number` of a Sobol set with linear scrambling and a digital shift. Digits below those of the set are to be made
// independent for every point; the variance is then close to that of Owen's scrambling (Owen 2003). Primitive
// polynomials and initial direction numbers by Joe and Kuo (2008): x + 1 with 1; x^2 + x + 1 with 1, 3; x^3 + x + 1 with
// 1, 3, 1. The order of the points is scrambled too, because the high digits of the number are the low ones of the
// point; the first 2^k points are a net for every k.
static inline RandomWords sobol_point(Uint number, RandomWords random) {
  const Uint order = random.x + random.y;
  number ^= (number >> 1) & order;
  number ^= (number >> 2) & (order >> 5);
  number ^= (number >> 4) & (order >> 10);
  const uint of_y[MOST_POINT_BITS] = {0x80000000u, 0xc0000000u, 0xa0000000u, 0xf0000000u, 0x88000000u, 0xcc000000u};
  const uint of_z[MOST_POINT_BITS] = {0x80000000u, 0xc0000000u, 0x60000000u, 0x90000000u, 0xe8000000u, 0x5c000000u};
  const uint of_w[MOST_POINT_BITS] = {0x80000000u, 0xc0000000u, 0x20000000u, 0x50000000u, 0xf8000000u, 0x74000000u};
  RandomWords point;
  point.x = point.y = point.z = point.w = (Uint)(0u);
#pragma unroll
  for (int bit = 0; bit < MOST_POINT_BITS; ++bit) {
    const Uint digit = (Uint)(0u) - ((number >> bit) & 1u);
    point.x ^= digit & (0x80000000u >> bit);
    point.y ^= digit & of_y[bit];
    point.z ^= digit & of_z[bit];
    point.w ^= digit & of_w[bit];
  }
  point.x = scramble_digits(point.x, random.y) ^ random.x;
  point.y = scramble_digits(point.y, random.z) ^ random.y;
  point.z = scramble_digits(point.z, random.w) ^ random.z;
  point.w = scramble_digits(point.w, random.x) ^ random.w;
  return point;
}

// Point `number` of a lattice of 2^bits points (Sloan and Joe 1994) with a random shift (Cranley and Patterson 1976).
// The generating vector minimizes, over the sets of 4 to 64 points, the largest ratio of P2 (weight .6 for each
// dimension) to that of the best vector for this number of points. The numbers of the points are multiplied by a random
// odd number.
static inline RandomWords lattice_point(Uint number, uint bits, RandomWords random) {
  const Uint step = (number * (random.x | 1u)) << (32u - bits);
  RandomWords point;
  point.x = step + random.x;
  point.y = step * 3u + random.y;
  point.z = step * 11u + random.z;
  point.w = step * 27u + random.w;
  return point;
}

#endif
