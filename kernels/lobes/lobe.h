// The interface of a reflectance model. A model NAME (struct Name) is one file, NAME.cl, that declares its parameters and
// defines four functions of them:
//
//   LobeValue NAME_evaluate(Name m, Vec3 fixed, Vec3 generated)     f_r and both sampling densities
//   LobeSample NAME_sample(Name m, Vec3 fixed, Real choice, RandomDraws random, Mask active)
//   Vec3 NAME_reflectivity(Name m, Vec3 fixed)                      integral of f_r cos over the hemisphere, per channel
//
// Directions are unit vectors in a frame whose z is the shading normal, and point away from the surface. `fixed` is the
// direction that is known: towards the camera on an eye subpath, towards the light on a light subpath; it lies above the
// surface. `generated` is the other one. A model is reciprocal; its densities are not.
//
// Roulette, sides and the choice among the models of a scene are in material.cl, which also sets f_r and weights to 0
// below the surface: a model may return any value there, and any density that is finite. `phlux verify --lobe` checks all
// that is stated here.
//
// The declaration of the parameters is a list of COLOUR and NUMBER entries, each with its default, its range and its
// meaning. The members of the struct, the record on the device, the reader of scene files and its messages follow from
// it (host/lobes):
//
//   #define NAME_PARAMETERS(COLOUR, NUMBER)                             \
//     COLOUR(reflectance, 0.5, 0, 1, "fraction of light reflected")     \
//     NUMBER(exponent, 30, 0, 1e30, "exponent of the lobe")
//   LOBE_STRUCT(Name, NAME)
//
// Optional: NAME_DERIVED(NUMBER, INDEX), members that the host computes for a model that ships; NAME_HAS_DELTA 1 where
// samples may be delta events; NAME_NEEDS_TANGENTS 1 where f_r depends on the longitude: x of the frame is then along the
// surface's first tangent; NAME_TEXTURED(m), the model with those derived members that depend on colours computed anew,
// where a colour comes from a texture; NAME_REFLECTIVITY_IS_ESTIMATE 1 where NAME_reflectivity is no exact integral: roulette is
// unbiased with any value above 0, and the nearer it is, the lower the variance;
// NAME_SURVIVAL(m, fixed, random), the probability that a path survives roulette, where it is not the largest channel
// of the reflectivity.
#ifndef PHLUX_LOBE_H
#define PHLUX_LOBE_H

#include "math/constants.h"
#include "math/directions.h"
#include "math/random.h"
#include "math/vectors.h"

typedef struct {
  Vec3 value;   // f_r, 1 / sr; no part of it is a delta distribution
  Real density; // of sampling `generated` for this `fixed`, per solid angle
  Real reverse; // of sampling `fixed` for this `generated`, per solid angle
} LobeValue;

typedef struct {
  Vec3 direction; // generated; a sample below the surface has weight 0
  Vec3 weight;    // f_r cos / density, per channel; of a delta event its reflectance
  Real density;   // per solid angle; of a delta event any positive number
  Mask delta;     // the direction was sampled from a delta distribution
  Int draws;      // directions that were drawn to find this one
} LobeSample;

// A model's parameters in every lane, and the tables of the models that have some.
#define LOBE_COLOUR_MEMBER(name, otherwise, lowest, highest, meaning) Vec3 name;
#define LOBE_NUMBER_MEMBER(name, otherwise, lowest, highest, meaning) Real name;
#define LOBE_DERIVED_MEMBER(name) Real name;
#define LOBE_INDEX_MEMBER(name) Int name;
// The same in memory.
#define LOBE_COLOUR_WORDS(name, otherwise, lowest, highest, meaning) float name[3];
#define LOBE_NUMBER_WORD(name, otherwise, lowest, highest, meaning) float name;
#define LOBE_DERIVED_WORD(name) float name;
#define LOBE_INDEX_WORD(name) int name;

#define LOBE_STRUCT(Name, NAME)                                                                                        \
  typedef struct {                                                                                                     \
    NAME##_PARAMETERS(LOBE_COLOUR_MEMBER, LOBE_NUMBER_MEMBER) /**/                                                     \
        NAME##_DERIVED(LOBE_DERIVED_MEMBER, LOBE_INDEX_MEMBER) const __global float* tables;                           \
  } Name;                                                                                                              \
  typedef struct {                                                                                                     \
    NAME##_PARAMETERS(LOBE_COLOUR_WORDS, LOBE_NUMBER_WORD) /**/                                                        \
        NAME##_DERIVED(LOBE_DERIVED_WORD, LOBE_INDEX_WORD) int end;                                                    \
  } Name##Record;

// A sample whose density and weight are those of the whole model.
static inline LobeSample lobe_sample(Vec3 direction, LobeValue v) {
  LobeSample s;
  s.direction = direction;
  s.density = v.density;
  s.weight = vec_scale(direction.z / v.density, v.value);
  s.weight = vec_select(v.density > 0.0f, s.weight, vec_all((Real)(0.0f)));
  s.delta = NO_LANES;
  s.draws = (Int)(1);
  return s;
}

#endif
