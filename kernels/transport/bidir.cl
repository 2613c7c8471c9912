// Bidirectional path tracing (Lafortune and Willems 1993): a subpath from a light, one from the camera, and weighted
// connections of their vertices (mis_weights.cl). A batch has three stages: its light subpaths are traced, then its eye
// subpaths, then pairs of their vertices are connected. Each stage keeps all lanes busy.
#include "transport/eye_subpath.cl"
#include "transport/light_subpath.cl"

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

// ---- Eye subpaths

// Adds light that an eye subpath found: with s = 0 (a hit) or s = 1 (a light sample).
static inline Contribution found_by(const Subpath* s, FoundLight light, int light_vertices) {
  return to_own_pixel(s->path, s->sequence.pixel, light.value, light.weight, TECHNIQUE(light_vertices, s->edges + 1));
}

// Traces the eye subpaths of the batch, and adds the light that they hit and sample. Returns whether there was room for
// their vertices.
static inline int trace_eye_subpaths(WorkItem* work, Batch batch) {
  const Scene* scene = work->scene;
  Subpath s = no_subpath(work->seed, work->sets), next = s;
  WaitingSubpaths waiting;
  waiting.count = 0;
  StoredSubpath stored = nothing_stored();
  Mask alive = NO_LANES;
  for (int row = 0;; ++row) {
    const Mask idle = !alive;
    while (wants_subpaths(&waiting, &batch, count_lanes(idle))) {
      const Mask started = take_paths(&batch, &next.path, ALL_LANES);
      find_path(work->list, &batch, next.path, &next.sequence);
      start_at_camera(scene, &next);
      put_subpaths(&waiting, &next, started);
    }
    const Mask starting = take_subpaths(&waiting, &s, idle);
    alive |= starting;
    if (!any_lane(alive)) return 1;
    if (row == work->eye.rows) return 0;

    const Mask tracing = alive;
    const Arrival arrival = next_vertex(scene, &s, 0, work->limits, tracing);
    work->rays += (uint)count_lanes(tracing);
    const Mask leaves_scene = tracing & !arrival.hits;
    if (HAS_SKY && any_lane(leaves_scene)) {
      const FoundLight sky = hit_sky(scene, &s, leaves_scene);
      add_contribution(&work->output, found_by(&s, sky, 0), sky.found);
    }
    const FoundLight hit = hit_light(scene, &s, arrival.vertex.point, arrival.distance, arrival.hits);
    if (any_lane(hit.found)) add_contribution(&work->output, found_by(&s, hit, 0), hit.found);

    const Real length = edge_length(&s, arrival.distance);
    s.mis = mis_arrived(s.mis, length * length, -vec_dot(arrival.vertex.point.normal, s.ray.direction));
    store_vertices(&work->eye, row, &s, arrival.vertex, &stored, starting, arrival.scattered);
    LightSample light;
    const Mask reaches = draw_light(scene, &s, arrival.vertex, &light, arrival.scattered);
    if (any_lane(reaches)) {
      const FoundLight sampled = sampled_light(scene, &s, arrival.vertex, light, reaches);
      add_if_unoccluded(scene, &work->queue, &work->output, light.ray, light.distance, found_by(&s, sampled, 1),
                        reaches & brings_light(sampled.value));
    }
    MaterialSample sample;
    alive = scatter(&s, arrival.vertex, 0, DIMENSION_SCATTERING(s.edges), work->limits, &sample, arrival.scattered);
    set_stored(&work->eye, s.path, stored, tracing & !alive);
  }
}

// ---- Connections

// The pair of vertices of each lane. Indices are those of vertices after the first of their subpaths, from 0.
typedef struct {
  Int path;
  Uint pixel;
  StoredSubpath light, eye;
  Int light_index, eye_index;
  Int light_count; // number of light vertices to which a connection does not make the path too long
  Uint word, step; // random numbers for the roulette of connections
} Pair;

// Roulette of connections: e - 2 connections can make a path of e edges, and share its radiance by their weights. If
// this is more than CONNECTIONS, each connection is made with the probability CONNECTIONS / (e - 2).
static inline Real connection_probability(const Pair* pair) {
  if (CONNECTIONS == 0) return (Real)(1.0f);
  const Int most = pair->light_index + pair->eye_index + 1; // e - 2
  return smaller((float)CONNECTIONS / to_real(most), (Real)(1.0f));
}
static inline Mask is_connected(const Pair* pair) {
  if (CONNECTIONS == 0) return ALL_LANES;
  const Uint number = int_to_uint(pair->light_index << 16 | (pair->eye_index + 1));
  return uniform_real(further_word(pair->word, pair->step, number)) < connection_probability(pair);
}

static inline Int connectable(const WorkItem* work, const Pair* pair) {
  return min(pair->light.length, work->limits.longest - 2 - pair->eye_index);
}

// Gives paths with pairs to the lanes that are not `pairing`; returns the lanes that have a path.
static inline Mask take_pairs(const WorkItem* work, Batch* batch, Pair* pair, Mask pairing) {
  while (!all_lanes(pairing)) {
    const Mask starting = take_paths(batch, &pair->path, !pairing);
    if (!any_lane(starting)) break;
    RandomSequence sequence;
    sequence.seed = work->seed;
    sequence.sets = work->sets;
    find_path(work->list, batch, pair->path, &sequence);
    pair->pixel = starting ? sequence.pixel : pair->pixel;
    if (CONNECTIONS > 0) {
      const RandomWords words = random_words(sequence, (Uint)(DIMENSION_CONNECTIONS), 0);
      pair->word = starting ? words.x : pair->word;
      pair->step = starting ? words.y : pair->step;
    }
    const StoredSubpath light = stored_of(&work->light, pair->path), eye = stored_of(&work->eye, pair->path);
    pair->light.first = starting ? light.first : pair->light.first;
    pair->light.length = starting ? light.length : pair->light.length;
    pair->eye.first = starting ? eye.first : pair->eye.first;
    pair->eye.length = starting ? eye.length : pair->eye.length;
    pair->light_index = starting ? (Int)(0) : pair->light_index;
    pair->eye_index = starting ? (Int)(0) : pair->eye_index;
    pair->light_count = connectable(work, pair);
    pairing |= starting & (pair->eye.length > 0) & (pair->light_count > 0);
  }
  return pairing;
}

// Moves the lanes of m to the next pair that is to be connected; returns the lanes that have one.
static inline Mask next_pair(const WorkItem* work, Pair* pair, Mask m) {
  Mask pairing = m;
  for (Mask moving = m; any_lane(moving); moving &= pairing & !is_connected(pair)) {
    pair->light_index += moving ? (Int)(1) : (Int)(0);
    const Mask next_eye = moving & (pair->light_index >= pair->light_count);
    pair->light_index = next_eye ? (Int)(0) : pair->light_index;
    pair->eye_index += next_eye ? (Int)(1) : (Int)(0);
    pair->light_count = connectable(work, pair);
    pairing &= (pair->eye_index < pair->eye.length) & (pair->light_count > 0);
  }
  return pairing;
}

// Connects the eye vertex and the light vertex of the lanes of m.
static inline void connect(WorkItem* work, const Pair* pair, StoredVertex eye, StoredVertex light, Mask m) {
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
  const Vec3 reflected = vec_mul(vec_mul(eye.throughput, at_eye.value), vec_mul(light.throughput, at_light.value));
  const Real geometry = abs_cosine(to_light.z) * adjoint_cosine(light.vertex, to_eye, light_cosine) / distance2 *
                        radiance_scale(eye.vertex.material, to_light);
  const Vec3 value = vec_scale(geometry / connection_probability(pair), reflected);
  const Real light_side =
      connection_side(light.mis, at_eye.density, at_light.reverse, distance2, abs_cosine(light_cosine));
  const Real eye_side = connection_side(eye.mis, at_light.density, at_eye.reverse, distance2, abs_cosine(eye_cosine));
  add_if_unoccluded(work->scene, &work->queue, &work->output, ray, distance,
                    to_own_pixel(pair->path, pair->pixel, value, weight_of_connection(light_side, eye_side),
                                 TECHNIQUE(pair->light_index + 2, pair->eye_index + 2)),
                    faces & brings_light(value));
}

static inline void connect_subpaths(WorkItem* work, Batch batch) {
  Pair pair;
  pair.path = (Int)(0);
  pair.pixel = pair.word = pair.step = (Uint)(0u);
  pair.light.first = pair.light.length = pair.eye.first = pair.eye.length = (Int)(0);
  pair.light_index = pair.eye_index = pair.light_count = (Int)(0);
  Mask pairing = NO_LANES;
  while (true) {
    pairing = take_pairs(work, &batch, &pair, pairing);
    if (!any_lane(pairing)) return;
    const StoredVertex eye =
        stored_vertex(work->scene, &work->eye, pairing ? pair.eye.first + pair.eye_index * ROW_WORDS : (Int)(0));
    const StoredVertex light =
        stored_vertex(work->scene, &work->light, pairing ? pair.light.first + pair.light_index * ROW_WORDS : (Int)(0));
    connect(work, &pair, eye, light, pairing);
    pairing = next_pair(work, &pair, pairing);
  }
}

// ---- Batches

// The part of `scratch` for a work-item, in words: light vertices, eye vertices, then a few words per path.
static inline void divide_scratch(WorkItem* work, __global Scalar* scratch, int rows, int paths) {
  const size_t vertices = (size_t)rows * ROW_WORDS, share = 2 * vertices + SCRATCH_WORDS_PER_PATH * (size_t)paths;
  __global Scalar* mine = scratch + get_global_id(0) * share;
  work->light.words = mine;
  work->eye.words = mine + vertices;
  work->light.rows = work->eye.rows = rows;
  __global int* per_path = (__global int*)(mine + 2 * vertices);
  work->light.first = per_path;
  work->light.length = per_path + paths;
  work->eye.first = per_path + 2 * paths;
  work->eye.length = per_path + 3 * paths;
  work->output.radiance = (__global float*)(per_path + 4 * paths);
}

__kernel void trace_bidir(SCENE_PARAMETERS, LAUNCH_PARAMETERS, int batch_jobs, int record_words, int record_capacity,
                          __global float* records, __global int* record_counts, int rows, __global Scalar* scratch,
                          __global float* sums) {
  SCENE_FROM_PARAMETERS
  LAUNCH_FROM_PARAMETERS
  WorkItem work;
  work.scene = &scene;
  work.list = list;
  work.limits = limits;
  work.seed = seed;
  work.sets = sets;
  work.rays = 0;
  empty_shadow_queue(&work.queue);
  divide_scratch(&work, scratch, rows, batch_jobs * block_samples);
  for (int index = (int)get_global_id(0); index < batch_count(list, batch_jobs); index += (int)get_global_size(0)) {
    const Batch batch = batch_at(list, batch_jobs, index);
    output_to(&work.output, records, index, record_words, record_capacity);
    for (int word = 0; word < 4 * batch.path_count; ++word) work.output.radiance[word] = 0.0f;
    const int fits = trace_light_subpaths(&work, batch) && trace_eye_subpaths(&work, batch);
    if (fits) connect_subpaths(&work, batch);
    trace_last_shadow_rays(&scene, &work.queue, &work.output);
    sum_jobs(&work.output, batch.job, batch.jobs, block_samples, sums);
    record_counts[index] = fits ? work.output.count : -1;
  }
  __global uint* mine = counters + get_global_id(0) * 2;
  mine[0] = work.rays;
  mine[1] = work.queue.traced;
}
