// Records of several lanes in private memory, with an array for every word of a record. The fields of a record are a
// list,
//   #define FIELDS(VECTOR, NUMBER, INTEGER, UNSIGNED) VECTOR(ray.origin) NUMBER(distance) INTEGER(path) UNSIGNED(pixel)
// from which the functions that write and read records are made.
#ifndef PHLUX_LANE_RECORDS_H
#define PHLUX_LANE_RECORDS_H

#include "math/vectors.h"

// Number of words of a list of fields.
#define VECTOR_WORDS(member) +3
#define SCALAR_WORD(member) +1
#define RECORD_WORDS_OF(FIELDS) (0 FIELDS(VECTOR_WORDS, SCALAR_WORD, SCALAR_WORD, SCALAR_WORD))

// Capacity: two records for each lane.
typedef Scalar LaneWords[2 * LANES];

// Each function handles the words of the next field and advances *word.

// Writes the records of the lanes of m from record `at` on, in lane order.
static inline void put_number(LaneWords* words, int* word, int at, Real v, Mask m) {
  lanes_to_array(pack_lanes(m, v), words[(*word)++] + at);
}
static inline void put_vector(LaneWords* words, int* word, int at, Vec3 v, Mask m) {
  put_number(words, word, at, v.x, m);
  put_number(words, word, at, v.y, m);
  put_number(words, word, at, v.z, m);
}

// Reads the records from `at` on, one in each lane.
static inline Real number_at(const LaneWords* words, int* word, int at) {
  return lanes_from_array(words[(*word)++] + at);
}
static inline Vec3 vector_at(const LaneWords* words, int* word, int at) {
  Vec3 v;
  v.x = number_at(words, word, at);
  v.y = number_at(words, word, at);
  v.z = number_at(words, word, at);
  return v;
}

// The same in the lanes of m, in lane order; the others keep `old`.
static inline Real take_number(const LaneWords* words, int* word, int at, Real old, Mask m) {
  return unpack_lanes(m, number_at(words, word, at), old);
}
static inline Vec3 take_vector(const LaneWords* words, int* word, int at, Vec3 old, Mask m) {
  Vec3 v;
  v.x = take_number(words, word, at, old.x, m);
  v.y = take_number(words, word, at, old.y, m);
  v.z = take_number(words, word, at, old.z, m);
  return v;
}

#endif
