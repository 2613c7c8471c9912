// Counter-based random numbers: Philox 4x32 (Salmon, Moraes, Dror, Shaw 2011) maps (pixel, sample, dimension, draw) to
// four random words; the seed is its key. There is no state, so that an image depends only on the seed, not on how the
// work is divided into launches and threads.
#ifndef PHLUX_RANDOM_H
#define PHLUX_RANDOM_H

#include "math/point_sets.h"

// 7 is the smallest number of rounds that passes BigCrush (table 2 of the paper); the paper recommends 10.
#ifndef PHILOX_ROUNDS
#define PHILOX_ROUNDS 7
#endif

// How the samples of a pixel are related: independent, or points of low-discrepancy sets.
#define SAMPLER_INDEPENDENT 0
#define SAMPLER_SOBOL 1
#define SAMPLER_LATTICE 2
#ifndef SAMPLER
#define SAMPLER SAMPLER_INDEPENDENT
#endif

static inline RandomWords philox(RandomWords counter, uint2 key) {
  RandomWords c = counter;
  uint2 k = key;
  for (int round = 0; round < PHILOX_ROUNDS; ++round) {
    Uint high0, low0, high1, low1;
    multiply_wide(c.x, 0xD2511F53u, &high0, &low0);
    multiply_wide(c.z, 0xCD9E8D57u, &high1, &low1);
    // Mesa 25.0 (rusticl) loses a RandomWords that is copied here.
    c.x = high1 ^ c.y ^ k.x;
    c.y = low1;
    c.z = high0 ^ c.w ^ k.y;
    c.w = low0;
    k += (uint2)(0x9E3779B9u, 0xBB67AE85u);
  }
  return c;
}

// The point sets of a launch: the samples of a pixel from number `first` on form sets of 2^bits samples.
typedef struct {
  uint first, bits;
} PointSets;

// The position of a path in the sequence: the pixel (or light path) and the sample.
typedef struct {
  Uint pixel, sample;
  uint2 seed;
  PointSets sets; // not used by independent samples
} RandomSequence;

// Four independent random words, see random_words.
static inline RandomWords independent_words(RandomSequence sequence, Uint sample, Uint dimension, uint draw) {
  RandomWords counter;
  counter.x = sequence.pixel;
  counter.y = sample;
  counter.z = dimension;
  counter.w = (Uint)(draw);
  return philox(counter, sequence.seed);
}

// Further words, one for each number above 0, from two of random_words: for many choices with little effect each. They
// are the final steps of MurmurHash3 on a Weyl sequence.
static inline Uint further_word(Uint first, Uint step, Uint number) {
  Uint h = first + (step | 1u) * number;
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  return h ^ (h >> 16);
}

// Four random words for one sampling decision of a path. `dimension` is the number of the decision (such as
// 2 bounce + 1), `draw` the repetition of a sampler that draws until it accepts. With a low-discrepancy sampler, the
// words of draw 0 are a point of the sample's set. Sets are padded: each set and each dimension is randomized
// separately.
static inline RandomWords random_words(RandomSequence sequence, Uint dimension, uint draw) {
  if (SAMPLER == SAMPLER_INDEPENDENT || draw > 0 || sequence.sets.bits == 0)
    return independent_words(sequence, sequence.sample, dimension, draw);
  const Uint number = (sequence.sample - sequence.sets.first) & ((1u << sequence.sets.bits) - 1u);
  const RandomWords random = independent_words(sequence, sequence.sample - number, dimension, 0);
  if (SAMPLER == SAMPLER_LATTICE) return lattice_point(number, sequence.sets.bits, random);
  // With Owen's scrambling the digits below those of the set are independent for every point.
  RandomWords point = sobol_point(number, random);
  point.x ^= further_word(random.x, random.y, 4 * number + 1) >> sequence.sets.bits;
  point.y ^= further_word(random.x, random.y, 4 * number + 2) >> sequence.sets.bits;
  point.z ^= further_word(random.x, random.y, 4 * number + 3) >> sequence.sets.bits;
  point.w ^= further_word(random.x, random.y, 4 * number + 4) >> sequence.sets.bits;
  return point;
}

// Random numbers for one sampling decision: the words of its first draw, and what further draws need.
typedef struct {
  RandomWords words;
  RandomSequence sequence;
  Uint dimension;
} RandomDraws;

static inline RandomDraws random_draws(RandomSequence sequence, Uint dimension) {
  RandomDraws random;
  random.words = random_words(sequence, dimension, 0);
  random.sequence = sequence;
  random.dimension = dimension;
  return random;
}

// The words of draw 1, 2, ...
static inline RandomWords draw_again(RandomDraws random, uint draw) {
  return random_words(random.sequence, random.dimension, draw);
}

// Uniform in the open interval (0, 1): 2^23 equidistant values, from 2^-24 to 1 - 2^-24.
static inline Real uniform_real(Uint word) {
  return fma(uint_to_real(word >> 9), (Real)(1.1920928955078125e-07f), (Real)(5.9604644775390625e-08f));
}

#endif
