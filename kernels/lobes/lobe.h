// The interface of a reflectance model. A model NAME (struct Name) is one file, NAME.cl, that declares its parameters
// and defines three functions of them:
//
//   LobeValue NAME_evaluate(Name m, Vec3 fixed, Vec3 generated)     f_r and both sampling densities
//   LobeSample NAME_sample(Name m, Vec3 fixed, Real choice, RandomDraws random, Mask active)
//   Vec3 NAME_reflectivity(Name m, Vec3 fixed)                      integral of f_r |cos| over all directions, per channel
//
// Directions are unit vectors in a frame whose z is the shading normal, and point away from the surface. `fixed` is the
// known direction: towards the camera on an eye subpath, towards the light on a light subpath; it is above the surface.
// `generated` is the other direction. f_r is reciprocal; the densities need not be.
//
// material.cl implements Russian roulette, the sides of surfaces and the choice among the models of a scene. It also
// sets f_r and weights to 0 below the surface, where a model may return any value and any finite density. `phlux verify
// --lobe` checks everything that is stated here.
//
// A model that transmits light defines NAME_TRANSMITS 1, and Real NAME_INDEX(m), the index of refraction below the
// surface relative to that on the side of `fixed` (1 if rays are not refracted). It scatters on both sides of a
// surface: m.front tells the side of `fixed`, and `generated` may be below. f_r and weights are those of power that
// goes from `fixed` to `generated`, so that energy is conserved. With I = NAME_INDEX, f_r(b, a) = f_r(a, b) / I(a)^2
// for a and b on different sides (Veach 1997, 5.2). Radiance is divided by I^2 (radiance_scale, material.cl).
//
// The parameters are declared by a list of COLOUR and NUMBER entries, each with its default, range and meaning. The
// members of the struct, the record on the device, the reader of scene files and its messages follow from it
// (host/lobes):
//
//   #define NAME_PARAMETERS(COLOUR, NUMBER)                             \
//     COLOUR(reflectance, 0.5, 0, 1, "fraction of light reflected")     \
//     NUMBER(exponent, 30, 0, 1e30, "exponent of the lobe")
//   LOBE_STRUCT(Name, NAME)
//
// Optional:
//   NAME_DERIVED(NUMBER, INDEX)      members that the host computes, only for models that ship
//   NAME_TEXTURED(m)                 m with derived members computed again from its colours, which come from textures
//   NAME_HAS_DELTA 1                 samples may be delta events
//   NAME_NEEDS_TANGENTS 1            f_r depends on the longitude: x of the frame is along the surface's first tangent
//   NAME_REFLECTIVITY_IS_ESTIMATE 1  NAME_reflectivity is not the exact integral. Roulette is unbiased with any value
//                                    above 0, and the variance is lower with a better estimate
//   NAME_SURVIVAL(m, fixed, random)  survival probability of roulette; default: largest channel of the reflectivity
#ifndef PHLUX_LOBE_H
#define PHLUX_LOBE_H

#include "math/constants.h"
#include "math/directions.h"
#include "math/random.h"
#include "math/vectors.h"

typedef struct {
  Vec3 value;   // f_r in 1 / sr, without delta distributions
  Real density; // of sampling `generated` for this `fixed`, per solid angle
  Real reverse; // of sampling `fixed` for this `generated`, per solid angle
} LobeValue;

typedef struct {
  Vec3 direction; // generated; below the surface its weight is 0 unless the model transmits; z = 0: no direction
  Vec3 weight;    // f_r |cos| / density, per channel; of a delta event: its reflectance
  Real density;   // per solid angle; of a delta event: any positive number
  Mask delta;     // the direction was sampled from a delta distribution
  Int draws;      // number of directions drawn until this one was accepted
} LobeSample;

// The parameters of a model in every lane, and its tables, if it has any.
#define LOBE_COLOUR_MEMBER(name, otherwise, lowest, highest, meaning) Vec3 name;
#define LOBE_NUMBER_MEMBER(name, otherwise, lowest, highest, meaning) Real name;
#define LOBE_DERIVED_MEMBER(name) Real name;
#define LOBE_INDEX_MEMBER(name) Int name;
// The record of these parameters in memory.
#define LOBE_COLOUR_WORDS(name, otherwise, lowest, highest, meaning) float name[3];
#define LOBE_NUMBER_WORD(name, otherwise, lowest, highest, meaning) float name;
#define LOBE_DERIVED_WORD(name) float name;
#define LOBE_INDEX_WORD(name) int name;

#define LOBE_STRUCT(Name, NAME)                                                                                        \
  typedef struct {                                                                                                     \
    NAME##_PARAMETERS(LOBE_COLOUR_MEMBER, LOBE_NUMBER_MEMBER) /**/                                                     \
        NAME##_DERIVED(LOBE_DERIVED_MEMBER, LOBE_INDEX_MEMBER) const __global float* tables;                           \
    Mask front; /* `fixed` lies on the front of the surface */                                                         \
  } Name;                                                                                                              \
  typedef struct {                                                                                                     \
    NAME##_PARAMETERS(LOBE_COLOUR_WORDS, LOBE_NUMBER_WORD) /**/                                                        \
        NAME##_DERIVED(LOBE_DERIVED_WORD, LOBE_INDEX_WORD) int end;                                                    \
  } Name##Record;

// A sample with the density and the weight f_r |cos| / density of the whole model.
static inline LobeSample lobe_sample(Vec3 direction, LobeValue v) {
  LobeSample s;
  s.direction = direction;
  s.density = v.density;
  s.weight = vec_scale(fabs(direction.z) / v.density, v.value);
  s.weight = vec_select(v.density > 0.0f, s.weight, vec_all((Real)(0.0f)));
  s.delta = NO_LANES;
  s.draws = (Int)(1);
  return s;
}

// ---- Delta events

// For a model whose f_r has only delta distributions.
static inline LobeValue no_lobe_value(void) {
  LobeValue v;
  v.value = vec_all((Real)(0.0f));
  v.density = v.reverse = (Real)(0.0f);
  return v;
}

static inline LobeSample delta_sample(Vec3 direction, Vec3 weight) {
  LobeSample s;
  s.direction = direction;
  s.weight = weight;
  s.density = (Real)(1.0f);
  s.delta = ALL_LANES;
  s.draws = (Int)(1);
  return s;
}

// Reflectivity of a surface that reflects the fraction `reflectance` and transmits the rest, each times its factor.
static inline Vec3 reflected_and_transmitted(Real reflectance, Vec3 reflected, Vec3 transmitted) {
  return vec_along(vec_scale(reflectance, reflected), 1.0f - reflectance, transmitted);
}

// Chooses, by a uniform number, between reflection of the fraction `reflectance` and transmission of the rest, in
// proportion to both fractions times the largest channels of their factors.
typedef struct {
  Mask reflects;
  Vec3 weight;
} DeltaChoice;

static inline DeltaChoice reflect_or_transmit(Real reflectance, Vec3 reflected, Vec3 transmitted, Real choice) {
  const Real most_reflected = vec_max(reflected), most_transmitted = vec_max(transmitted);
  const Real reflects = reflectance * most_reflected, all = fma(1.0f - reflectance, most_transmitted, reflects);
  DeltaChoice c;
  c.reflects = choice * all < reflects;
  const Real most = c.reflects ? most_reflected : most_transmitted;
  c.weight = vec_scale(most > 0.0f ? all / most : (Real)(0.0f), vec_select(c.reflects, reflected, transmitted));
  return c;
}

#endif
