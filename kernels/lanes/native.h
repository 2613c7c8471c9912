// The processor's own instructions for masks, permutations and compression of lanes. LANES_NATIVE is defined if the
// compiler has them as builtins: for 16 lanes those of AVX-512, for 8 lanes those of AVX2 and BMI2. LANES_PORTABLE
// selects the portable forms of across.h and memory.h.
#ifndef PHLUX_LANES_NATIVE_H
#define PHLUX_LANES_NATIVE_H

#include "lanes/types.h"

#if WIDTH != 1 && !defined(LANES_PORTABLE) && defined(__has_builtin)

// clang before 8 declares the indices of gathersiv16sf as floats.
#if WIDTH == 16 && defined(__AVX512F__) && __clang_major__ >= 8
#if __has_builtin(__builtin_ia32_gathersiv16sf) && __has_builtin(__builtin_ia32_gathersiv16si) &&                      \
    __has_builtin(__builtin_ia32_scattersiv16sf) && __has_builtin(__builtin_ia32_scattersiv16si) &&                    \
    __has_builtin(__builtin_ia32_cmpd512_mask) && __has_builtin(__builtin_ia32_compresssf512_mask) &&                  \
    __has_builtin(__builtin_ia32_expandsf512_mask) && __has_builtin(__builtin_ia32_expandsi512_mask) &&                \
    __has_builtin(__builtin_ia32_permvarsf512)
#define LANES_NATIVE
#define LANES_GATHER
#endif
// pdep and pext of Zen 1 and 2 take hundreds of cycles.
#elif WIDTH == 8 && defined(__AVX2__) && defined(__BMI2__) && !defined(__znver1__) && !defined(__znver2__)
#if __has_builtin(__builtin_ia32_movmskps256) && __has_builtin(__builtin_ia32_permvarsf256) &&                         \
    __has_builtin(__builtin_ia32_pdep_di) && __has_builtin(__builtin_ia32_pext_di) &&                                  \
    __has_builtin(__builtin_convertvector)
#define LANES_NATIVE
#endif
#endif

#ifdef LANES_NATIVE

typedef float LaneNativeFloats __attribute__((vector_size(4 * WIDTH)));
typedef int LaneNativeInts __attribute__((vector_size(4 * WIDTH)));
#define LANE_NATIVE_FLOATS(x) __builtin_astype((x), LaneNativeFloats)
#define LANE_NATIVE_INTS(x) __builtin_astype((x), LaneNativeInts)
#define LANE_REALS(x) __builtin_astype((x), Real)
#define LANE_INTS(x) __builtin_astype((x), Int)
#define LANE_ALL_BITS ((1u << WIDTH) - 1u)

#if WIDTH == 16

static inline uint native_bits(Mask m) {
  return (ushort)__builtin_ia32_cmpd512_mask(LANE_NATIVE_INTS(m), LANE_NATIVE_INTS((Int)(0)), 4, (ushort)0xffff);
}
static inline Real native_gather(const __global float* base, Int index) {
  return LANE_REALS(__builtin_ia32_gathersiv16sf(LANE_NATIVE_FLOATS((Real)(0.0f)), (const void*)(size_t)base,
                                                 LANE_NATIVE_INTS(index), (ushort)0xffff, 4));
}
static inline Int native_gather_int(const __global int* base, Int index) {
  return LANE_INTS(__builtin_ia32_gathersiv16si(LANE_NATIVE_INTS((Int)(0)), (const void*)(size_t)base,
                                                LANE_NATIVE_INTS(index), (ushort)0xffff, 4));
}
static inline void native_scatter(__global float* base, Int index, Real v, Mask m) {
  __builtin_ia32_scattersiv16sf((void*)(size_t)base, (ushort)native_bits(m), LANE_NATIVE_INTS(index),
                                LANE_NATIVE_FLOATS(v), 4);
}
static inline void native_scatter_int(__global int* base, Int index, Int v, Mask m) {
  __builtin_ia32_scattersiv16si((void*)(size_t)base, (ushort)native_bits(m), LANE_NATIVE_INTS(index),
                                LANE_NATIVE_INTS(v), 4);
}
static inline Real native_permute(Real v, Int index) {
  return LANE_REALS(__builtin_ia32_permvarsf512(LANE_NATIVE_FLOATS(v), LANE_NATIVE_INTS(index)));
}
static inline Real native_pack(Mask m, Real v) {
  return LANE_REALS(__builtin_ia32_compresssf512_mask(LANE_NATIVE_FLOATS(v), LANE_NATIVE_FLOATS((Real)(0.0f)),
                                                      (ushort)native_bits(m)));
}
static inline Real native_unpack(Mask m, Real v, Real old) {
  return LANE_REALS(
      __builtin_ia32_expandsf512_mask(LANE_NATIVE_FLOATS(v), LANE_NATIVE_FLOATS(old), (ushort)native_bits(m)));
}
static inline Int native_rank(Mask m) {
  return LANE_INTS(__builtin_ia32_expandsi512_mask(LANE_NATIVE_INTS(LANE_NUMBERS), LANE_NATIVE_INTS((Int)(0)),
                                                   (ushort)native_bits(m)));
}

#else

static inline uint native_bits(Mask m) { return (uint)__builtin_ia32_movmskps256(LANE_NATIVE_FLOATS(m)); }
// Only the lowest three bits of an index are used.
static inline Real native_permute(Real v, Int index) {
  return LANE_REALS(__builtin_ia32_permvarsf256(LANE_NATIVE_FLOATS(v), LANE_NATIVE_INTS(index)));
}
// Lane numbers as the bytes of a word. chosen_bytes sets all bits of the bytes of the lanes in m.
#define LANE_NUMBER_BYTES 0x0706050403020100ul
static inline ulong chosen_bytes(Mask m) { return __builtin_ia32_pdep_di(native_bits(m), 0x0101010101010101ul) * 0xff; }
static inline Int bytes_to_lanes(ulong bytes) { return __builtin_convertvector(__builtin_astype(bytes, uchar8), Int); }
static inline Int native_rank(Mask m) {
  return bytes_to_lanes(__builtin_ia32_pdep_di(LANE_NUMBER_BYTES, chosen_bytes(m)));
}
static inline Real native_pack(Mask m, Real v) {
  return native_permute(v, bytes_to_lanes(__builtin_ia32_pext_di(LANE_NUMBER_BYTES, chosen_bytes(m))));
}
static inline Real native_unpack(Mask m, Real v, Real old) { return m ? native_permute(v, native_rank(m)) : old; }

#endif
#endif
#endif

#endif
