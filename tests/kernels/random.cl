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
  sequence.sets.first = sequence.sets.bits = 0u;
  answer[i] = random_words(sequence, place[i].z, draw);
}

// The words of `sample` in sets of 2^bits samples from `first` on.
__kernel void set_words(__global const Uint* sample, uint pixel, uint dimension, uint2 seed, uint first, uint bits,
                        __global RandomWords* answer) {
  const size_t i = get_global_id(0);
  RandomSequence sequence;
  sequence.pixel = (Uint)(pixel);
  sequence.sample = sample[i];
  sequence.seed = seed;
  sequence.sets.first = first;
  sequence.sets.bits = bits;
  answer[i] = random_words(sequence, (Uint)(dimension), 0);
}

// Not scrambled.
__kernel void sobol_points(__global const Uint* number, __global RandomWords* answer) {
  RandomWords none;
  none.x = none.y = none.z = none.w = (Uint)(0u);
  answer[get_global_id(0)] = sobol_point(number[get_global_id(0)], none);
}

__kernel void uniforms(__global const Uint* word, __global Real* uniform) {
  const size_t i = get_global_id(0);
  uniform[i] = uniform_real(word[i]);
}

__kernel void rounds(__global int* count) { *count = PHILOX_ROUNDS; }
