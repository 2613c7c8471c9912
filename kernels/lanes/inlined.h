// Built-in functions of a few instructions, for vectors. LLVM 19 (PoCL 6) does not inline a function into another that
// treats denormals differently, as LLVM 15 did. Kernels are built with -cl-denorms-are-zero and a driver's library is
// not, so that fma would be a call, and a render would take up to 1.8 times as long. The builtins of clang are inlined.
#ifndef PHLUX_LANES_INLINED_H
#define PHLUX_LANES_INLINED_H

#if WIDTH != 1 && defined(__has_builtin)
#if __has_builtin(__builtin_elementwise_fma) && __has_builtin(__builtin_elementwise_sqrt) &&                           \
    __has_builtin(__builtin_elementwise_rint) && __has_builtin(__builtin_elementwise_copysign)

#define INLINED(type, name, parameters) static inline type __attribute__((overloadable)) inlined_##name parameters
#define INLINED_REAL(type)                                                                                             \
  INLINED(type, fma, (type a, type b, type c)) { return __builtin_elementwise_fma(a, b, c); }                          \
  INLINED(type, sqrt, (type x)) { return __builtin_elementwise_sqrt(x); }                                              \
  INLINED(type, fabs, (type x)) { return __builtin_elementwise_abs(x); }                                               \
  INLINED(type, floor, (type x)) { return __builtin_elementwise_floor(x); }                                            \
  INLINED(type, rint, (type x)) { return __builtin_elementwise_rint(x); }                                              \
  INLINED(type, fmin, (type a, type b)) { return __builtin_elementwise_min(a, b); }                                    \
  INLINED(type, fmax, (type a, type b)) { return __builtin_elementwise_max(a, b); }                                    \
  INLINED(type, copysign, (type a, type b)) { return __builtin_elementwise_copysign(a, b); }
#define INLINED_INT(type)                                                                                              \
  INLINED(type, min, (type a, type b)) { return __builtin_elementwise_min(a, b); }                                     \
  INLINED(type, max, (type a, type b)) { return __builtin_elementwise_max(a, b); }
#define INLINED_EACH(functions, type)                                                                                  \
  functions(type) functions(type##2) functions(type##3) functions(type##4) functions(type##8) functions(type##16)

INLINED_EACH(INLINED_REAL, float)
INLINED_EACH(INLINED_INT, int)
INLINED_EACH(INLINED_INT, uint)

#undef fma // a macro of PoCL, as are the others
#undef sqrt
#undef fabs
#undef floor
#undef rint
#undef fmin
#undef fmax
#undef copysign
#undef min
#undef max
#define fma inlined_fma
#define sqrt inlined_sqrt
#define fabs inlined_fabs
#define floor inlined_floor
#define rint inlined_rint
#define fmin inlined_fmin
#define fmax inlined_fmax
#define copysign inlined_copysign
#define min inlined_min
#define max inlined_max

#endif
#endif

#endif
