// AVX-512 has single instructions for gathers, permutations, compression and expansion of 16 lanes. LANES_AVX512 is
// defined if the compiler has them as builtins; LANES_PORTABLE selects the portable forms. clang before 8 declares the
// indices of gathersiv16sf as floats.
#ifndef PHLUX_LANES_AVX512_H
#define PHLUX_LANES_AVX512_H

#include "lanes/types.h"

#if WIDTH == 16 && defined(__AVX512F__) && !defined(LANES_PORTABLE) && defined(__has_builtin) && __clang_major__ >= 8
#if __has_builtin(__builtin_ia32_gathersiv16sf) && __has_builtin(__builtin_ia32_gathersiv16si) &&                      \
    __has_builtin(__builtin_ia32_cmpd512_mask) && __has_builtin(__builtin_ia32_compresssf512_mask) &&                  \
    __has_builtin(__builtin_ia32_expandsf512_mask) && __has_builtin(__builtin_ia32_expandsi512_mask) &&                \
    __has_builtin(__builtin_ia32_permvarsf512)
#define LANES_AVX512
typedef float LaneNativeFloats __attribute__((vector_size(64)));
typedef int LaneNativeInts __attribute__((vector_size(64)));
#define LANE_NATIVE_FLOATS(x) __builtin_astype((x), LaneNativeFloats)
#define LANE_NATIVE_INTS(x) __builtin_astype((x), LaneNativeInts)
#define LANE_REALS(x) __builtin_astype((x), Real)
#define LANE_INTS(x) __builtin_astype((x), Int)
#endif
#endif

#endif
