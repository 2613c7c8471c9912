// The material of a surface: its reflectance model, the sides that reflect, and Russian roulette.
//
// The host writes lobes/models.cl (host/lobes): it includes the files of the models that the scene has and lists them,
//   #define MODELS(MODEL) MODEL(0, phong, Phong, PHONG) MODEL(1, mirror, Mirror, MIRROR)
#ifndef PHLUX_MATERIAL_CL
#define PHLUX_MATERIAL_CL

#include "lobes/models.cl"
#include "scene/scene.cl"
#include "scene/textures.cl"

// Values of ROULETTE: the survival probability.
#define ROULETTE_STRATEGY 0     // NAME_SURVIVAL of lobe.h: the reflectivity, or an estimate of it by the strategy
#define ROULETTE_REFLECTIVITY 1 // the reflectivity of the vertex
#define ROULETTE_KD_KS 2        // kd + ks
#define ROULETTE_THROUGHPUT 3   // throughput x reflectivity: survivors have throughput 1, as in Mitsuba and pbrt
#define ROULETTE_EFFICIENCY 4   // min(1, EFFICIENCY_FACTOR x throughput x reflectivity)
#define ROULETTE_BY_THROUGHPUT (ROULETTE == ROULETTE_THROUGHPUT | ROULETTE == ROULETTE_EFFICIENCY)

// The most efficient survival probability is the throughput times the ratio of sqrt(variance / cost) of the rest of the
// path to that of the whole path (Bolin and Meyer, An Error Metric for Monte Carlo Ray Tracing, 1997; Rath et al.,
// EARS, 2022). This ratio is taken to be a constant, the best of those that were measured (bench/saved/ROULETTE.md).
#define EFFICIENCY_FACTOR 2.0f

// Upper bound on the survival probability, so that every path ends, also in a room that absorbs nothing.
#define LARGEST_SURVIVAL 0.999f

#define MATERIAL_MEMBER(number, model, Model, MODEL) Model model;
typedef struct {
  Int model_number; // in MODELS
  MODELS(MATERIAL_MEMBER)
} Material;

// The lanes whose material has this model.
static inline Mask has_model(Material m, int number) {
  return MODEL_COUNT > 1 ? (Mask)(m.model_number == number) : ALL_LANES;
}

// Whether the functions of this model must be called: with one lane only those of its own model. With more lanes all
// models are called: no scene gained by the test.
static inline int needs_model(Material m, int number) { return LANES > 1 || any_lane(has_model(m, number)); }

// ---- Loading a material: its record is a header, followed by the parameters of its model.

#define WORD_OF(record, member)                                                                                        \
  (MATERIAL_HEADER + (int)((const __global float*)&(record)->member - (const __global float*)(record)))

// The colour whose record begins at `word`: from its texture in the lanes of m that have one; in other lanes
// `recorded`.
static inline Vec3 textured_colour(const Scene* scene, Int material, int word, TextureCoordinates at, Mask m,
                                   Vec3 recorded) {
  const Int number = gather_int(scene->texture_numbers + word, material * MATERIAL_WORDS) - 1;
  const Mask textured = m & (number >= 0);
  if (!any_lane(textured)) return recorded;
  return vec_select(textured, texture_colour(scene, number, at, textured), recorded);
}

#define LOAD_COLOUR(name, otherwise, lowest, highest, meaning)                                                         \
  m.name = material_vec(scene, index, WORD_OF(record, name[0]));                                                       \
  if (HAS_TEXTURES) m.name = textured_colour(scene, index, WORD_OF(record, name[0]), at, of_model, m.name);
#define LOAD_NUMBER(name, otherwise, lowest, highest, meaning) LOAD_DERIVED(name)
#define LOAD_DERIVED(name) m.name = material_real(scene, index, WORD_OF(record, name));
// Indices into tables must be valid in the lanes of other models too.
#define LOAD_INDEX(name) m.name = of_model ? material_int(scene, index, WORD_OF(record, name)) : (Int)(0);
#define LOAD_MODEL(number, model, Model, MODEL)                                                                        \
  static inline Model load_##model(const Scene* scene, Int index, TextureCoordinates at, Mask front, Mask of_model) {  \
    const __global Model##Record* record = (const __global Model##Record*)(scene->materials + MATERIAL_HEADER);        \
    Model m;                                                                                                           \
    MODEL##_PARAMETERS(LOAD_COLOUR, LOAD_NUMBER) /**/                                                                  \
        MODEL##_DERIVED(LOAD_DERIVED, LOAD_INDEX) m.tables = scene->lobe_tables;                                       \
    m.front = front;                                                                                                   \
    if (HAS_TEXTURES) m = MODEL##_TEXTURED(m);                                                                         \
    return m;                                                                                                          \
  }
MODELS(LOAD_MODEL)

// Material `index`, with its colours at these texture coordinates. `front`: the known direction is on the front of the
// surface.
static inline Material material_at(const Scene* scene, Int index, TextureCoordinates at, Mask front) {
  Material m;
  m.model_number = MODEL_COUNT > 1 ? material_int(scene, index, MATERIAL_MODEL) : (Int)(0);
#define LOAD_MATERIAL(number, model, Model, MODEL)                                                                     \
  m.model = load_##model(scene, index, at, front, has_model(m, number));
  MODELS(LOAD_MATERIAL)
  return m;
}

// The lanes whose surface scatters light on the side that was hit.
static inline Mask reflects(const Scene* scene, Int material, Mask front) {
  if (!(HAS_TWO_SIDED | HAS_BLACK)) return front;
  const Int side = front ? (Int)(MATERIAL_FRONT) : (Int)(MATERIAL_BACK);
  return (material_int(scene, material, MATERIAL_FLAGS) & side) != 0;
}

// ---- The functions of lobe.h, for the model of each lane

// The lanes whose model may scatter into this direction.
static inline Mask may_scatter_into(Material m, Vec3 generated) {
  Mask possible = generated.z > 0.0f;
#define MAY_SCATTER(number, model, Model, MODEL)                                                                       \
  if (MODEL##_TRANSMITS) possible = possible | has_model(m, number);
  MODELS(MAY_SCATTER)
  return possible;
}

// The factor by which radiance changes, but not importance or power, when light is refracted: the square of the
// relative index of refraction (Veach 1997, 5.2). It applies to eye subpaths.
static inline Real radiance_scale(Material m, Vec3 generated) {
  Real index = (Real)(1.0f);
#define INDEX(number, model, Model, MODEL)                                                                             \
  if (MODEL##_TRANSMITS) index = has_model(m, number) ? MODEL##_INDEX(m.model) : index;
  MODELS(INDEX)
  return generated.z < 0.0f ? 1.0f / (index * index) : (Real)(1.0f);
}

static inline LobeValue material_evaluate(Material m, Vec3 fixed, Vec3 generated) {
  LobeValue v;
  v.value = vec_all((Real)(0.0f));
  v.density = v.reverse = (Real)(0.0f);
#define EVALUATE(number, model, Model, MODEL)                                                                          \
  if (needs_model(m, number)) {                                                                                        \
    const LobeValue of_model = model##_evaluate(m.model, fixed, generated);                                            \
    const Mask chosen = has_model(m, number);                                                                          \
    v.value = vec_select(chosen, of_model.value, v.value);                                                             \
    v.density = chosen ? of_model.density : v.density;                                                                 \
    v.reverse = chosen ? of_model.reverse : v.reverse;                                                                 \
  }
  MODELS(EVALUATE)
  v.value = vec_select((fixed.z > 0.0f) & may_scatter_into(m, generated), v.value, vec_all((Real)(0.0f)));
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

// By NAME_SURVIVAL of the model or its sampling strategy.
static inline Real survival_by_strategy(Material m, Vec3 fixed, RandomDraws random) {
  Real survival = (Real)(LARGEST_SURVIVAL);
#define SURVIVAL(number, model, Model, MODEL)                                                                          \
  survival = has_model(m, number) ? MODEL##_SURVIVAL(m.model, fixed, random) : survival;
  MODELS(SURVIVAL)
  return survival;
}

// kd + ks of the Phong model is its reflectivity for the normal, where no part of the lobe is below the surface. Other
// models may have a larger reflectivity for other directions.
static inline Real survival_by_kd_ks(Material m, Vec3 fixed) {
  const Vec3 normal = vec3((Real)(0.0f), (Real)(0.0f), (Real)(1.0f));
  return larger(vec_max(material_reflectivity(m, normal)), vec_max(material_reflectivity(m, fixed)));
}

// The survival probability of the paths of `roulette`; 1 for other paths. `throughput` is that of the path up to this
// vertex, relative to that of a path that no surface attenuates (Subpath.unattenuated). The largest channel is used:
// with the mean of the channels a path between red walls would have infinite variance in red.
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
  Vec3 direction; // below the surface its weight is 0 unless the model transmits
  Vec3 weight;    // f_r |cos| / (density x survival probability), per channel
  Real density;   // of `direction`, on the condition that the path survives
  Mask survives;  // roulette; 1 in lanes without roulette
  Mask delta;     // `direction` was sampled from a delta distribution
  Int draws;      // directions that were drawn to find this one
} MaterialSample;

// Applies roulette to the paths of `roulette`, then samples the model for the paths of `active` that survive.
static inline MaterialSample material_sample(Material m, Vec3 fixed, RandomDraws random, Vec3 throughput, Mask roulette,
                                             Mask active) {
  const Real u = uniform_real(random.words.x), survival = material_survival(m, fixed, random, throughput, roulette);
  const Real inverse_survival = 1.0f / survival;
  const Real choice = smaller(u * inverse_survival, (Real)(ONE_MINUS_EPSILON)); // uniform if the path survives
  MaterialSample s;
  s.survives = u < survival;
  s.direction = fixed;
  s.weight = vec_all((Real)(0.0f));
  s.density = (Real)(0.0f);
  s.delta = NO_LANES;
  s.draws = (Int)(1);
#define SAMPLE(number, model, Model, MODEL)                                                                            \
  if (needs_model(m, number)) {                                                                                        \
    const Mask chosen = has_model(m, number);                                                                          \
    const LobeSample of_model = model##_sample(m.model, fixed, choice, random, active & s.survives & chosen);          \
    s.direction = vec_select(chosen, of_model.direction, s.direction);                                                 \
    s.weight = vec_select(chosen, of_model.weight, s.weight);                                                          \
    s.density = chosen ? of_model.density : s.density;                                                                 \
    s.delta = s.delta | (chosen & of_model.delta);                                                                     \
    s.draws = chosen ? of_model.draws : s.draws;                                                                       \
  }
  MODELS(SAMPLE)
  s.weight = vec_select(may_scatter_into(m, s.direction), vec_scale(inverse_survival, s.weight), vec_all((Real)(0.0f)));
  return s;
}

#endif
