// Subpaths that wait to be traced. They are started for all lanes at once; idle lanes take them, the last one first.
#ifndef PHLUX_WAITING_SUBPATHS_CL
#define PHLUX_WAITING_SUBPATHS_CL

#include "transport/batch.cl"
#include "transport/lane_records.h"
#include "transport/subpath.cl"

// The data of a subpath before its first edge.
#define WAITING_FIELDS(VECTOR, NUMBER, INTEGER, UNSIGNED)                                                              \
  VECTOR(ray.origin)                                                                                                   \
  VECTOR(ray.direction) VECTOR(throughput) INTEGER(path) UNSIGNED(sequence.pixel) UNSIGNED(sequence.sample)
#define WAITING_FIELDS_OF_ROULETTE(VECTOR, NUMBER, INTEGER, UNSIGNED) NUMBER(unattenuated)
#define WAITING_FIELDS_OF_BIDIR(VECTOR, NUMBER, INTEGER, UNSIGNED) NUMBER(mis.d_vcm) NUMBER(light_cosine) INTEGER(light)
#define WAITING_WORDS                                                                                                  \
  (RECORD_WORDS_OF(WAITING_FIELDS) + (ROULETTE_BY_THROUGHPUT ? RECORD_WORDS_OF(WAITING_FIELDS_OF_ROULETTE) : 0) +      \
   (IS_BIDIR ? RECORD_WORDS_OF(WAITING_FIELDS_OF_BIDIR) : 0))

typedef struct {
  LaneWords words[WAITING_WORDS];
  int count;
} WaitingSubpaths;

// Whether this number of idle lanes needs more subpaths than wait, and the batch has more.
static inline int wants_subpaths(const WaitingSubpaths* waiting, const Batch* batch, int idle) {
  return waiting->count < idle && batch->next < batch->path_count;
}

#define PUT_VECTOR(member) put_vector(waiting->words, &word, waiting->count, s->member, m);
#define PUT_NUMBER(member) put_number(waiting->words, &word, waiting->count, s->member, m);
#define PUT_INTEGER(member) put_number(waiting->words, &word, waiting->count, carry_int(s->member), m);
#define PUT_UNSIGNED(member) put_number(waiting->words, &word, waiting->count, carry_int(uint_to_int(s->member)), m);

// Adds the subpaths of the lanes of m.
static inline void put_subpaths(WaitingSubpaths* waiting, const Subpath* s, Mask m) {
  int word = 0;
  WAITING_FIELDS(PUT_VECTOR, PUT_NUMBER, PUT_INTEGER, PUT_UNSIGNED)
  if (ROULETTE_BY_THROUGHPUT) {
    WAITING_FIELDS_OF_ROULETTE(PUT_VECTOR, PUT_NUMBER, PUT_INTEGER, PUT_UNSIGNED)
  }
  if (IS_BIDIR) {
    WAITING_FIELDS_OF_BIDIR(PUT_VECTOR, PUT_NUMBER, PUT_INTEGER, PUT_UNSIGNED)
  }
  waiting->count += count_lanes(m);
}

#define TAKE_VECTOR(member) s->member = take_vector(waiting->words, &word, waiting->count, s->member, starting);
#define TAKE_NUMBER(member) s->member = take_number(waiting->words, &word, waiting->count, s->member, starting);
#define TAKE_INTEGER(member)                                                                                           \
  s->member = carried_int(take_number(waiting->words, &word, waiting->count, carry_int(s->member), starting));
#define TAKE_UNSIGNED(member)                                                                                          \
  s->member = int_to_uint(                                                                                             \
      carried_int(take_number(waiting->words, &word, waiting->count, carry_int(uint_to_int(s->member)), starting)));

// Gives waiting subpaths to lanes of `idle`, as many as there are; returns these lanes.
static inline Mask take_subpaths(WaitingSubpaths* waiting, Subpath* s, Mask idle) {
  const int taken = min(waiting->count, count_lanes(idle));
  const Mask starting = idle & (rank_lanes(idle) < taken);
  waiting->count -= taken;
  int word = 0;
  WAITING_FIELDS(TAKE_VECTOR, TAKE_NUMBER, TAKE_INTEGER, TAKE_UNSIGNED)
  if (ROULETTE_BY_THROUGHPUT) {
    WAITING_FIELDS_OF_ROULETTE(TAKE_VECTOR, TAKE_NUMBER, TAKE_INTEGER, TAKE_UNSIGNED)
  }
  s->edges = starting ? (Int)(0) : s->edges;
  s->delta = s->delta & !starting;
  if (IS_BIDIR) {
    WAITING_FIELDS_OF_BIDIR(TAKE_VECTOR, TAKE_NUMBER, TAKE_INTEGER, TAKE_UNSIGNED)
    s->mis.d_vc = starting ? (Real)(0.0f) : s->mis.d_vc;
  }
  return starting;
}

#endif
