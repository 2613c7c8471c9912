// Bidirectional path tracing (Lafortune and Willems 1993): a subpath from a light, one from the eye, and every way to
// join them, weighted (weights.cl). A batch's light subpaths are walked first, then its eye subpaths, then the pairs of
// their vertices are connected; each stage keeps all lanes busy by itself.
#include "transport/light_walk.cl"
#include "transport/vertex_store.cl"

// What the stages of a work-item share.
typedef struct {
  const Scene* scene;
  JobList list;
  WalkLimits limits;
  int sky_light;
  uint2 seed;
  ShadowQueue queue;
  Output output;
  VertexStore light, eye;
  uint rays;
} Bidir;

// Starts lanes of `idle` on subpaths that wait, whose vertices stand from `row` on; returns those lanes.
static inline Mask begin_trails(Starts* starts, Walk* walk, Trail* trail, int row, Mask idle) {
  const Mask starting = take_starts(starts, walk, idle);
  trail->first = starting ? row * ROW_WORDS + LANE_NUMBERS : trail->first;
  trail->length = starting ? (Int)(0) : trail->length;
  return starting;
}

// ---- Light subpaths

// The density with which a light sample at the vertex would have found the point that the light subpath set out from,
// `distance` away, in the lanes of m: a light without a surface counts as light_sample says.
static inline Real density_of_start(const Scene* scene, const Walk* walk, Vertex v, Real distance, Mask m) {
  const Vec3 lit = v.point.position;
  const Real choice = probability_for(scene, lit, v.point.normal, walk->light, m);
  const Int kind = light_kind(scene, walk->light);
  Real density = choice;
  if (HAS_AREA_LIGHTS) {
    const Mask surface = LIGHT_IS(kind, LIGHT_PLANAR) | LIGHT_IS(kind, LIGHT_SPHERE);
    density = surface ? light_density(scene, lit, walk->light, choice, distance, walk->light_cosine) : density;
  }
  if (HAS_POINTLIKE_LIGHTS) density = is_pointlike(kind) ? choice * distance * distance : density;
  if (HAS_CONSTANT_LIGHT) density = LIGHT_IS(kind, LIGHT_CONSTANT) ? choice * v.fixed.z * INV_PI : density;
  return density;
}

// Lanes whose light a ray can find.
static inline Mask is_hittable(const Scene* scene, Int light) {
  const Int kind = light_kind(scene, light);
  return (kind != LIGHT_POINT) & (kind != LIGHT_SPOT) & (kind != LIGHT_DIRECTIONAL);
}

// The ratios of a light subpath that has arrived at the vertex.
static inline Ratios arrived_from_light(const Scene* scene, const Walk* walk, Vertex v, Real distance) {
  const Real cosine = -vec_dot(v.point.normal, walk->ray.direction);
  const Ratios later = ratios_arrived(walk->ratios, distance * distance, cosine);
  const Mask first = walk->edges == 1;
  if (!any_lane(first)) return later;
  const Real emission = LIGHT_REAL(scene, walk->light, emission_density);
  const Ratios start = ratios_from_light(density_of_start(scene, walk, v, distance, first), emission, cosine,
                                         is_hittable(scene, walk->light));
  Ratios r;
  r.edge = first ? start.edge : later.edge;
  r.rest = first ? start.rest : later.rest;
  return r;
}

// Walks the batch's light subpaths and shows them to the eye. Returns whether there was room for their vertices.
static inline int walk_light_subpaths(Bidir* b, Batch batch) {
  const Scene* scene = b->scene;
  Walk walk = no_walk(b->seed), next = no_walk(b->seed);
  Starts starts = no_starts();
  Trail trail = no_trail();
  Mask alive = NO_LANES;
  for (int row = 0;; ++row) {
    const Mask idle = !alive;
    while (wants_starts(&starts, &batch, count_lanes(idle))) {
      Mask started;
      const Mask shines = leave_light(scene, b->list, &batch, b->limits, &next, &b->queue, &b->output, &started);
      put_starts(&starts, &next, shines);
      store_trail(&b->light, next.path, no_trail(), started & !shines);
    }
    alive |= begin_trails(&starts, &walk, &trail, row, idle);
    if (!any_lane(alive)) return 1;
    if (row == b->light.rows) return 0;

    const Hit hit = scene_intersect(scene, walk.ray, alive);
    b->rays += (uint)count_lanes(alive);
    walk.edges += alive ? (Int)(1) : (Int)(0);
    const SurfacePoint point = surface_point(scene, walk.ray, hit);
    const Vertex vertex = vertex_at(scene, walk.ray, point);
    const Mask walking = alive;
    const Mask reflecting = alive & (hit.primitive >= 0) & (walk.edges < b->limits.edges) & can_reflect(scene, vertex);
    walk.ratios = arrived_from_light(scene, &walk, vertex, hit.distance);
    store_vertex(&b->light, row, &walk, vertex);
    trail.length += reflecting ? (Int)(1) : (Int)(0);
    show_vertex(scene, &walk, vertex, &b->queue, &b->output, reflecting);
    alive = walk_on(&walk, vertex, 1, DIMENSION_LIGHT_PATH(walk.edges), walk.edges >= b->limits.roulette,
                    reflecting & (walk.edges + 1 < b->limits.edges));
    store_trail(&b->light, walk.path, trail, walking & !alive);
  }
}

// ---- Eye subpaths

static inline Contribution to_own_pixel(Int path, Uint pixel, Vec3 value, Real weight, Int technique) {
  Contribution c;
  c.path = path;
  c.pixel = uint_to_int(pixel);
  c.own = ALL_LANES;
  c.value = value;
  c.weight = weight;
  c.technique = technique;
  return c;
}

// The batch's next eye subpaths, as leave_light.
static inline Mask leave_eye(const Bidir* b, Batch* batch, Walk* walk) {
  const Mask starting = take_paths(batch, &walk->path, ALL_LANES);
  find_path(b->list, batch, walk->path, &walk->sequence);
  const RandomWords words = random_words(walk->sequence, (Uint)(0), 0);
  const Vec3 forward = broadcast_vec(b->scene->camera->forward);
  walk->ray = camera_ray(b->scene, walk->sequence.pixel, uniform_real(words.x), uniform_real(words.y));
  walk->throughput = vec_all((Real)(1.0f));
  walk->ratios = ratios_from_eye(film_density(b->scene, vec_dot(walk->ray.direction, forward)));
  return starting;
}

// Adds what a light that the eye subpaths of m have hit sends back along them.
static inline void add_hit_light(Bidir* b, const Walk* walk, SurfacePoint point, Real distance, Mask m) {
  if (!HAS_AREA_LIGHTS) return;
  const Mask emits = m & point.front & (point.light >= 0);
  if (!any_lane(emits)) return;
  const Scene* scene = b->scene;
  const Int light = max(point.light, (Int)(0));
  const Real cosine = -vec_dot(point.normal, walk->ray.direction);
  const Real emission = LIGHT_REAL(scene, light, emission_density);
  const Real seen = PI * emission * distance * distance / cosine;
  const Mask sampled = emits & (walk->edges > 1);
  const Real choice = probability_for(scene, walk->ray.origin, walk->normal, light, sampled);
  const Real found = light_density(scene, walk->ray.origin, light, choice, distance, cosine);
  const Real weight = weight_of_hit(walk->ratios, sampled ? found : seen, emission);
  const Vec3 value = vec_mul(walk->throughput, LIGHT_VEC3(scene, light, radiance));
  add_contribution(&b->output,
                   to_own_pixel(walk->path, walk->sequence.pixel, value, weight, TECHNIQUE(0, walk->edges + 1)), emits);
}

// The same for those that left the scene.
static inline void add_sky(Bidir* b, const Walk* walk, Mask m) {
  if (!HAS_CONSTANT_LIGHT || !any_lane(m)) return;
  const __global LightRecord* sky = b->scene->lights + b->sky_light;
  const Real seen = (Real)(0.25f * INV_PI * sky->probability);
  const Real sampled = sky->probability * walk->sky_density;
  const Real weight = weight_of_hit(walk->ratios, walk->edges == 1 ? seen : sampled, (Real)(sky->emission_density));
  const Vec3 value = vec_mul(walk->throughput, broadcast_vec(sky->radiance));
  add_contribution(&b->output,
                   to_own_pixel(walk->path, walk->sequence.pixel, value, weight, TECHNIQUE(0, walk->edges + 1)), m);
}

// Adds a light sample at the vertices of m.
static inline void add_light_sample(Bidir* b, const Walk* walk, Vertex v, Mask m) {
  const Scene* scene = b->scene;
  const RandomWords words = random_words(walk->sequence, DIMENSION_LIGHT(walk->edges), 0);
  const LightSample light = light_sample(scene, v.point, words);
  const Vec3 generated = to_frame(v.point.frame, light.ray.direction);
  const Real cosine = vec_dot(v.point.normal, light.ray.direction);
  const Mask reaches = m & light.valid & leaves(generated, cosine);
  if (!any_lane(reaches)) return;
  const LobeValue lobe = material_evaluate(v.material, v.fixed, generated);
  const Vec3 reflected = vec_mul(walk->throughput, lobe.value);
  const Vec3 value = vec_scale(generated.z / light.density, vec_mul(light.radiance, reflected));
  const Real weight =
      weight_of_light_sample(walk->ratios, light.density, LIGHT_REAL(scene, light.light, emission_density),
                             lobe.density, lobe.reverse, cosine, light.hittable);
  add_if_free(scene, &b->queue, &b->output, light.ray, light.distance,
              to_own_pixel(walk->path, walk->sequence.pixel, value, weight, TECHNIQUE(1, walk->edges + 1)),
              reaches & brings_light(value));
}

// Walks the batch's eye subpaths, adding the lights that they hit and sample. Returns whether there was room for their
// vertices.
static inline int walk_eye_subpaths(Bidir* b, Batch batch) {
  const Scene* scene = b->scene;
  Walk walk = no_walk(b->seed), next = no_walk(b->seed);
  Starts starts = no_starts();
  Trail trail = no_trail();
  Mask alive = NO_LANES;
  for (int row = 0;; ++row) {
    const Mask idle = !alive;
    while (wants_starts(&starts, &batch, count_lanes(idle))) put_starts(&starts, &next, leave_eye(b, &batch, &next));
    alive |= begin_trails(&starts, &walk, &trail, row, idle);
    if (!any_lane(alive)) return 1;
    if (row == b->eye.rows) return 0;

    const Hit hit = scene_intersect(scene, walk.ray, alive);
    b->rays += (uint)count_lanes(alive);
    walk.edges += alive ? (Int)(1) : (Int)(0);
    const Mask hits = alive & (hit.primitive >= 0);
    add_sky(b, &walk, alive & !hits);
    const SurfacePoint point = surface_point(scene, walk.ray, hit);
    add_hit_light(b, &walk, point, hit.distance, hits);

    const Vertex vertex = vertex_at(scene, walk.ray, point);
    const Mask walking = alive;
    const Mask reflecting = hits & (walk.edges < b->limits.edges) & can_reflect(scene, vertex);
    walk.ratios = ratios_arrived(walk.ratios, hit.distance * hit.distance, -vec_dot(point.normal, walk.ray.direction));
    store_vertex(&b->eye, row, &walk, vertex);
    trail.length += reflecting ? (Int)(1) : (Int)(0);
    add_light_sample(b, &walk, vertex, reflecting);
    alive = walk_on(&walk, vertex, 0, DIMENSION_REFLECTION(walk.edges), walk.edges >= b->limits.roulette, reflecting);
    store_trail(&b->eye, walk.path, trail, walking & !alive);
  }
}

// ---- Connections

// Each lane's pair of vertices: those after the first of their subpaths, counted from 0.
typedef struct {
  Int path;
  Uint pixel;
  Trail light, eye;
  Int light_index, eye_index;
  Int light_count; // of vertices that the eye's can be joined to without making too long a path
  Uint word, step; // whose further words decide on roulette
} Pair;

// A path of e edges can be made by e - 2 connections, each of which is expected to bring its share, and the less the
// longer the path is: of more than CONNECTIONS of them one is made with probability CONNECTIONS / (e - 2).
static inline Real connection_probability(const Pair* pair) {
  if (CONNECTIONS == 0) return (Real)(1.0f);
  const Int most = pair->light_index + pair->eye_index + 1; // e - 2
  return smaller((float)CONNECTIONS / to_real(most), (Real)(1.0f));
}
static inline Mask is_made(const Pair* pair) {
  if (CONNECTIONS == 0) return ALL_LANES;
  const Uint number = int_to_uint(pair->light_index << 16 | (pair->eye_index + 1));
  return uniform_real(further_word(pair->word, pair->step, number)) < connection_probability(pair);
}

static inline Int joinable(const Bidir* b, const Pair* pair) {
  return min(pair->light.length, b->limits.edges - 2 - pair->eye_index);
}

// Gives the lanes that are not `pairing` paths that have pairs; returns the lanes that are then.
static inline Mask take_pairs(const Bidir* b, Batch* batch, Pair* pair, Mask pairing) {
  while (!all_lanes(pairing)) {
    const Mask starting = take_paths(batch, &pair->path, !pairing);
    if (!any_lane(starting)) break;
    RandomSequence sequence;
    sequence.seed = b->seed;
    find_path(b->list, batch, pair->path, &sequence);
    pair->pixel = starting ? sequence.pixel : pair->pixel;
    if (CONNECTIONS > 0) {
      const RandomWords words = random_words(sequence, (Uint)(DIMENSION_CONNECTIONS), 0);
      pair->word = starting ? words.x : pair->word;
      pair->step = starting ? words.y : pair->step;
    }
    const Trail light = load_trail(&b->light, pair->path), eye = load_trail(&b->eye, pair->path);
    pair->light.first = starting ? light.first : pair->light.first;
    pair->light.length = starting ? light.length : pair->light.length;
    pair->eye.first = starting ? eye.first : pair->eye.first;
    pair->eye.length = starting ? eye.length : pair->eye.length;
    pair->light_index = starting ? (Int)(0) : pair->light_index;
    pair->eye_index = starting ? (Int)(0) : pair->eye_index;
    pair->light_count = joinable(b, pair);
    pairing |= starting & (pair->eye.length > 0) & (pair->light_count > 0);
  }
  return pairing;
}

// Moves the lanes of m to their next pairs that are made; returns those that have one.
static inline Mask next_pair(const Bidir* b, Pair* pair, Mask m) {
  Mask pairing = m;
  for (Mask moving = m; any_lane(moving); moving &= pairing & !is_made(pair)) {
    pair->light_index += moving ? (Int)(1) : (Int)(0);
    const Mask next_eye = moving & (pair->light_index >= pair->light_count);
    pair->light_index = next_eye ? (Int)(0) : pair->light_index;
    pair->eye_index += next_eye ? (Int)(1) : (Int)(0);
    pair->light_count = joinable(b, pair);
    pairing &= (pair->eye_index < pair->eye.length) & (pair->light_count > 0);
  }
  return pairing;
}

// Connects an eye vertex and a light vertex in the lanes of m.
static inline void connect(Bidir* b, const Pair* pair, Joint eye, Joint light, Mask m) {
  Real distance;
  const Ray ray = ray_between(surface_position(eye.vertex.point), surface_position(light.vertex.point), &distance);
  const Vec3 back = vec_scale((Real)(-1.0f), ray.direction);
  const Vec3 to_light = to_frame(eye.vertex.point.frame, ray.direction);
  const Vec3 to_eye = to_frame(light.vertex.point.frame, back);
  const Real eye_cosine = vec_dot(eye.vertex.point.normal, ray.direction);
  const Real light_cosine = vec_dot(light.vertex.point.normal, back);
  const Mask faces = m & leaves(to_light, eye_cosine) & leaves(to_eye, light_cosine);
  if (!any_lane(faces)) return;
  const Real distance2 = distance * distance;
  const LobeValue at_eye = material_evaluate(eye.vertex.material, eye.vertex.fixed, to_light);
  const LobeValue at_light = material_evaluate(light.vertex.material, light.vertex.fixed, to_eye);
  const Vec3 reflected =
      vec_mul(vec_mul(eye.throughput, at_eye.value), vec_mul(light.throughput, at_light.value));
  const Real geometry = to_light.z * adjoint_cosine(light.vertex, to_eye, light_cosine) / distance2;
  const Vec3 value = vec_scale(geometry / connection_probability(pair), reflected);
  const Real light_side = connection_side(light.ratios, at_eye.density, at_light.reverse, distance2, light_cosine);
  const Real eye_side = connection_side(eye.ratios, at_light.density, at_eye.reverse, distance2, eye_cosine);
  add_if_free(b->scene, &b->queue, &b->output, ray, distance,
              to_own_pixel(pair->path, pair->pixel, value, weight_of_connection(light_side, eye_side),
                           TECHNIQUE(pair->light_index + 2, pair->eye_index + 2)),
              faces & brings_light(value));
}

static inline void connect_subpaths(Bidir* b, Batch batch) {
  Pair pair;
  pair.path = (Int)(0);
  pair.pixel = pair.word = pair.step = (Uint)(0u);
  pair.light.first = pair.light.length = pair.eye.first = pair.eye.length = (Int)(0);
  pair.light_index = pair.eye_index = pair.light_count = (Int)(0);
  Mask pairing = NO_LANES;
  while (true) {
    pairing = take_pairs(b, &batch, &pair, pairing);
    if (!any_lane(pairing)) return;
    const Joint eye = load_vertex(b->scene, &b->eye, pairing ? pair.eye.first + pair.eye_index * ROW_WORDS : (Int)(0));
    const Joint light =
        load_vertex(b->scene, &b->light, pairing ? pair.light.first + pair.light_index * ROW_WORDS : (Int)(0));
    connect(b, &pair, eye, light, pairing);
    pairing = next_pair(b, &pair, pairing);
  }
}

// ---- Batches

// A work-item's share of `scratch`, in words: light vertices, eye vertices, then a few words per path.
static inline void divide_scratch(Bidir* b, __global Scalar* scratch, int rows, int paths) {
  const size_t vertices = (size_t)rows * ROW_WORDS, share = 2 * vertices + SCRATCH_WORDS_PER_PATH * (size_t)paths;
  __global Scalar* mine = scratch + get_global_id(0) * share;
  b->light.words = mine;
  b->eye.words = mine + vertices;
  b->light.rows = b->eye.rows = rows;
  __global int* per_path = (__global int*)(mine + 2 * vertices);
  b->light.first = per_path;
  b->light.length = per_path + paths;
  b->eye.first = per_path + 2 * paths;
  b->eye.length = per_path + 3 * paths;
  b->output.radiance = (__global float*)(per_path + 4 * paths);
}

__kernel void trace_bidir(SCENE_PARAMETERS, int pixel_count, int first_pixel, int job_count, int first_sample,
                          int block_samples, uint2 seed, int max_edges, int roulette_edges, __global uint* counters,
                          int batch_jobs, int record_words, int record_capacity, __global float* records,
                          __global int* record_counts, int sky_light, int rows, __global Scalar* scratch,
                          __global float* sums) {
  SCENE_FROM_PARAMETERS
  Bidir b;
  b.scene = &scene;
  const JobList list = {pixel_count, first_pixel, job_count, first_sample, block_samples};
  const WalkLimits limits = {max_edges, roulette_edges};
  b.list = list;
  b.limits = limits;
  b.sky_light = sky_light;
  b.seed = seed;
  b.queue.count = 0;
  b.queue.traced = 0;
  b.rays = 0;
  divide_scratch(&b, scratch, rows, batch_jobs * block_samples);
  for (int index = (int)get_global_id(0); index < batch_count(list, batch_jobs); index += (int)get_global_size(0)) {
    const Batch batch = batch_at(list, batch_jobs, index);
    b.output.records = records + (size_t)index * (size_t)record_words * (size_t)record_capacity;
    b.output.capacity = record_capacity;
    b.output.count = 0;
    for (int word = 0; word < 4 * batch.path_count; ++word) b.output.radiance[word] = 0.0f;
    const int fits = walk_light_subpaths(&b, batch) && walk_eye_subpaths(&b, batch);
    if (fits) connect_subpaths(&b, batch);
    trace_last(&scene, &b.queue, &b.output);
    sum_jobs(&b.output, batch.job, batch.jobs, block_samples, sums);
    record_counts[index] = fits ? b.output.count : -1;
  }
  __global uint* mine = counters + get_global_id(0) * 2;
  mine[0] = b.rays;
  mine[1] = b.queue.traced;
}
