// The material of a surface: which of the scene's reflectance models it has, which sides reflect, and roulette.
//
// The host writes lobes/models.cl (host/lobes): it includes the files of the models that the scene has and lists them,
//   #define MODELS(MODEL) MODEL(0, phong, Phong, PHONG) MODEL(1, conductor, Conductor, CONDUCTOR)
#ifndef PHLUX_MATERIAL_CL
#define PHLUX_MATERIAL_CL

#include "lobes/models.cl"
#include "scene/scene.cl"
#include "scene/textures.cl"

// ROULETTE is one of these: what the probability to survive is in proportion to.
#define ROULETTE_STRATEGY 0     // NAME_SURVIVAL of lobe.h: the reflectivity, unless the strategy knows only an estimate
#define ROULETTE_REFLECTIVITY 1 // the reflectivity of the vertex
#define ROULETTE_KD_KS 2        // kd + ks
#define ROULETTE_THROUGHPUT 3   // throughput x reflectivity: survivors have throughput 1, as in Mitsuba and pbrt
#define ROULETTE_EFFICIENCY 4   // the same x EFFICIENCY_FACTOR, or 1 where that is more
#define ROULETTE_BY_THROUGHPUT (ROULETTE == ROULETTE_THROUGHPUT | ROULETTE == ROULETTE_EFFICIENCY)

// The most efficient survival is the throughput times the ratio of sqrt(variance / cost) of the path from here on to that
// of the whole path (Bolin and Meyer, An Error Metric for Monte Carlo Ray Tracing, 1997; Rath et al., EARS, 2022). This
// ratio is taken to be a constant, the best of those measured in whole renders (bench/saved/ROULETTE.md).
#define EFFICIENCY_FACTOR 2.0f

// So that roulette ends every path, in a lossless room too.
#define LARGEST_SURVIVAL 0.999f

#define MATERIAL_MEMBER(number, model, Model, MODEL) Model model;
typedef struct {
  Int model_number; // in MODELS
  MODELS(MATERIAL_MEMBER)
} Material;

// Lanes whose material has this model.
static inline Mask has_model(Material m, int number) {
  return MODEL_COUNT > 1 ? (Mask)(m.model_number == number) : ALL_LANES;
}

// ---- Loading a material: a record has a header, then the words of its model's parameters.

#define WORD_OF(record, member)                                                                                        \
  (MATERIAL_HEADER + (int)((const __global float*)&(record)->member - (const __global float*)(record)))

// The colour whose record begins at `word`: from its texture in the lanes of m that have one, elsewhere `recorded`.
static inline Vec3 textured_colour(const Scene* scene, Int material, int word, TextureCoordinates at, Mask m,
                                   Vec3 recorded) {
  const Int number = gather_int(scene->texture_numbers + word, material * MATERIAL_WORDS) - 1;
  const Mask textured = m & (number >= 0);
  if (!any_lane(textured)) return recorded;
  return vec_select(textured, texture_colour(scene, number, at, textured), recorded);
}

#define LOAD_COLOUR(name, otherwise, lowest, highest, meaning)                                                         \
  m.name = vec3(material_real(scene, index, WORD_OF(record, name[0])),                                                 \
                material_real(scene, index, WORD_OF(record, name[1])),                                                 \
                material_real(scene, index, WORD_OF(record, name[2])));                                                \
  if (HAS_TEXTURES) m.name = textured_colour(scene, index, WORD_OF(record, name[0]), at, of_model, m.name);
#define LOAD_NUMBER(name, otherwise, lowest, highest, meaning) LOAD_DERIVED(name)
#define LOAD_DERIVED(name) m.name = material_real(scene, index, WORD_OF(record, name));
// An index into a table must be valid in the lanes of other models too.
#define LOAD_INDEX(name) m.name = of_model ? material_int(scene, index, WORD_OF(record, name)) : (Int)(0);
#define LOAD_MODEL(number, model, Model, MODEL)                                                                        \
  static inline Model load_##model(const Scene* scene, Int index, TextureCoordinates at, Mask of_model) {              \
    const __global Model##Record* record = (const __global Model##Record*)(scene->materials + MATERIAL_HEADER);        \
    Model m;                                                                                                           \
    MODEL##_PARAMETERS(LOAD_COLOUR, LOAD_NUMBER) /**/                                                                  \
        MODEL##_DERIVED(LOAD_DERIVED, LOAD_INDEX) m.tables = scene->lobe_tables;                                       \
    if (HAS_TEXTURES) m = MODEL##_TEXTURED(m);                                                                         \
    return m;                                                                                                          \
  }
MODELS(LOAD_MODEL)

// Material `index`, and its colours at these texture coordinates.
static inline Material material_at(const Scene* scene, Int index, TextureCoordinates at) {
  Material m;
  m.model_number = MODEL_COUNT > 1 ? material_int(scene, index, MATERIAL_MODEL) : (Int)(0);
#define LOAD_MATERIAL(number, model, Model, MODEL) m.model = load_##model(scene, index, at, has_model(m, number));
  MODELS(LOAD_MATERIAL)
  return m;
}

// Lanes whose surface reflects anything on the side that was hit.
static inline Mask reflects(const Scene* scene, Int material, Mask front) {
  if (!(HAS_TWO_SIDED | HAS_BLACK)) return front;
  const Int side = front ? (Int)(MATERIAL_FRONT) : (Int)(MATERIAL_BACK);
  return (material_int(scene, material, MATERIAL_FLAGS) & side) != 0;
}

// ---- The functions of lobe.h for whichever model a lane has

static inline LobeValue material_evaluate(Material m, Vec3 fixed, Vec3 generated) {
  LobeValue v;
  v.value = vec_all((Real)(0.0f));
  v.density = v.reverse = (Real)(0.0f);
#define EVALUATE(number, model, Model, MODEL)                                                                          \
  {                                                                                                                    \
    const LobeValue of_model = model##_evaluate(m.model, fixed, generated);                                            \
    const Mask chosen = has_model(m, number);                                                                          \
    v.value = vec_select(chosen, of_model.value, v.value);                                                             \
    v.density = chosen ? of_model.density : v.density;                                                                 \
    v.reverse = chosen ? of_model.reverse : v.reverse;                                                                 \
  }
  MODELS(EVALUATE)
  v.value = vec_select((fixed.z > 0.0f) & (generated.z > 0.0f), v.value, vec_all((Real)(0.0f)));
  return v;
}

static inline Vec3 material_reflectivity(Material m, Vec3 fixed) {
  Vec3 reflectivity = vec_all((Real)(0.0f));
#define REFLECTIVITY(number, model, Model, MODEL)                                                                      \
  reflectivity = vec_select(has_model(m, number), model##_reflectivity(m.model, fixed), reflectivity);
  MODELS(REFLECTIVITY)
  return reflectivity;
}

// ---- Russian roulette

// As the model or its sampling strategy has it.
static inline Real survival_by_strategy(Material m, Vec3 fixed, RandomDraws random) {
  Real survival = (Real)(LARGEST_SURVIVAL);
#define SURVIVAL(number, model, Model, MODEL)                                                                          \
  survival = has_model(m, number) ? MODEL##_SURVIVAL(m.model, fixed, random) : survival;
  MODELS(SURVIVAL)
  return survival;
}

// kd + ks of the Phong model is its reflectivity along the normal, where no part of the lobe is below the surface. A
// model may reflect more elsewhere.
static inline Real survival_by_kd_ks(Material m, Vec3 fixed) {
  const Vec3 normal = vec3((Real)(0.0f), (Real)(0.0f), (Real)(1.0f));
  return larger(vec_max(material_reflectivity(m, normal)), vec_max(material_reflectivity(m, fixed)));
}

// The probability with which the paths of `roulette` survive; all others do. `throughput` is that of the path up to this
// vertex, relative to its beginning. The largest channel decides: with the channels' mean a path between red walls would
// have infinite variance in red.
static inline Real material_survival(Material m, Vec3 fixed, RandomDraws random, Vec3 throughput, Mask roulette) {
  Real survival = (Real)(0.0f);
  if (ROULETTE == ROULETTE_STRATEGY) survival = survival_by_strategy(m, fixed, random);
  if (ROULETTE == ROULETTE_REFLECTIVITY) survival = vec_max(material_reflectivity(m, fixed));
  if (ROULETTE == ROULETTE_KD_KS) survival = survival_by_kd_ks(m, fixed);
  if (ROULETTE_BY_THROUGHPUT) {
    const Real next = vec_max(vec_mul(throughput, material_reflectivity(m, fixed)));
    survival = ROULETTE == ROULETTE_EFFICIENCY ? EFFICIENCY_FACTOR * next : next;
  }
  return roulette ? smaller(survival, (Real)(LARGEST_SURVIVAL)) : (Real)(1.0f);
}

typedef struct {
  Vec3 direction; // a sample below the surface has weight 0
  Vec3 weight;    // f_r cos / (density x survival probability), per channel
  Real density;   // of `direction`, given that the path survives
  Mask survives;  // roulette: all lanes in which it was not asked for
  Mask delta;     // `direction` was sampled from a delta distribution
  Int draws;      // directions that were drawn to find this one
} MaterialSample;

// Roulette for the paths of `roulette`, then a sample of the model for those of `active` that survive it.
static inline MaterialSample material_sample(Material m, Vec3 fixed, RandomDraws random, Vec3 throughput, Mask roulette,
                                             Mask active) {
  const Real u = uniform_real(random.words.x), survival = material_survival(m, fixed, random, throughput, roulette);
  const Real inverse_survival = 1.0f / survival;
  const Real choice = smaller(u * inverse_survival, (Real)(ONE_MINUS_EPSILON)); // uniform, of the paths that survive
  MaterialSample s;
  s.survives = u < survival;
  s.direction = fixed;
  s.weight = vec_all((Real)(0.0f));
  s.density = (Real)(0.0f);
  s.delta = NO_LANES;
  s.draws = (Int)(1);
#define SAMPLE(number, model, Model, MODEL)                                                                            \
  {                                                                                                                    \
    const Mask chosen = has_model(m, number);                                                                          \
    const LobeSample of_model = model##_sample(m.model, fixed, choice, random, active & s.survives & chosen);          \
    s.direction = vec_select(chosen, of_model.direction, s.direction);                                                 \
    s.weight = vec_select(chosen, of_model.weight, s.weight);                                                          \
    s.density = chosen ? of_model.density : s.density;                                                                 \
    s.delta = s.delta | (chosen & of_model.delta);                                                                     \
    s.draws = chosen ? of_model.draws : s.draws;                                                                       \
  }
  MODELS(SAMPLE)
  s.weight = vec_select(s.direction.z > 0.0f, vec_scale(inverse_survival, s.weight), vec_all((Real)(0.0f)));
  return s;
}

#endif
