#include "math/random.h"

__kernel void words(__global const RandomWords* counter, uint2 key, __global RandomWords* answer) {
  const size_t i = get_global_id(0);
  answer[i] = philox(counter[i], key);
}

// The result of random_words for the position of a path in the sequence; the counter's members in the order of RandomWords.
__kernel void sequence_words(__global const RandomWords* place, uint2 seed, uint draw, __global RandomWords* answer) {
  const size_t i = get_global_id(0);
  RandomSequence sequence;
  sequence.pixel = place[i].x;
  sequence.sample = place[i].y;
  sequence.seed = seed;
  answer[i] = random_words(sequence, place[i].z, draw);
}

__kernel void uniforms(__global const Uint* word, __global Real* uniform) {
  const size_t i = get_global_id(0);
  uniform[i] = uniform_real(word[i]);
}

__kernel void rounds(__global int* count) { *count = PHILOX_ROUNDS; }
