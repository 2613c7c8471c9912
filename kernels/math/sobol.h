// Owen-scrambled Sobol points in four dimensions.
#ifndef PHLUX_SOBOL_H
#define PHLUX_SOBOL_H

#include "lanes/lanes.h"

// A word for each dimension.
typedef struct {
  Uint x, y, z, w;
} RandomWords;

static inline Uint reverse_bits(Uint a) {
  a = ((a >> 1) & 0x55555555u) | ((a & 0x55555555u) << 1);
  a = ((a >> 2) & 0x33333333u) | ((a & 0x33333333u) << 2);
  a = ((a >> 4) & 0x0f0f0f0fu) | ((a & 0x0f0f0f0fu) << 4);
  a = ((a >> 8) & 0x00ff00ffu) | ((a & 0x00ff00ffu) << 8);
  return (a >> 16) | (a << 16);
}

// Nested uniform (Owen) scrambling of words whose lowest bit is the first digit (Laine and Karras 2011; constants by
// Burley 2020, Practical Hash-based Owen Scrambling): the flip of a digit depends on the seed and the digits before it.
static inline Uint scramble_reversed(Uint reversed, Uint seed) {
  Uint a = reversed + seed;
  a ^= a * 0x6c50b47cu;
  a ^= a * 0xb82f1e52u;
  a ^= a * 0xc7afe638u;
  a ^= a * 0x8d22f6e6u;
  return a;
}

// The point of this index < 2^bits, with the lowest bit as the first digit. Direction numbers by the recurrence of
// Bratley and Fox (1988), with the primitive polynomials and initial numbers of Joe and Kuo (2008) for dimensions 2 to
// 4: x + 1 with 1; x^2 + x + 1 with 1, 3; x^3 + x + 1 with 1, 3, 1. Dimension 1 is the radical inverse.
static inline RandomWords sobol_point_reversed(Uint index, int bits) {
  RandomWords point;
  point.x = index;
  point.y = point.z = point.w = (Uint)(0u);
  uint y = 1, z = 1, z1 = 3, w = 1, w1 = 3, w2 = 4; // of this bit, and of the next ones
  for (int bit = 0; bit < bits; ++bit) {
    const Uint digit = (Uint)(0u) - ((index >> bit) & 1u);
    point.y ^= digit & y;
    point.z ^= digit & z;
    point.w ^= digit & w;
    const uint z2 = z ^ (z << 2) ^ z1, w3 = w ^ (w << 3) ^ w1;
    y ^= y << 1;
    z = z1;
    z1 = z2;
    w = w1;
    w1 = w2;
    w2 = w3;
  }
  return point;
}

// Point `number` < 2^bits of a set of 2^bits points, scrambled by `seeds` in each dimension; their order is scrambled by
// `order`. The first 2^k points are a net for every k.
static inline RandomWords sobol_point(Uint number, int bits, RandomWords seeds, Uint order) {
  const Uint reversed = scramble_reversed(reverse_bits(number) >> (32 - bits), order);
  RandomWords point = sobol_point_reversed(reverse_bits(reversed) >> (32 - bits), bits);
  point.x = reverse_bits(scramble_reversed(point.x, seeds.x));
  point.y = reverse_bits(scramble_reversed(point.y, seeds.y));
  point.z = reverse_bits(scramble_reversed(point.z, seeds.z));
  point.w = reverse_bits(scramble_reversed(point.w, seeds.w));
  return point;
}

#endif
