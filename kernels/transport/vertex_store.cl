// The vertices of a batch's subpaths in memory. The vertex that lane l reaches in step t of its walk stands in column l
// of row t: a subpath's vertices are in consecutive rows of one column, and a row is written as it stands in registers.
#ifndef PHLUX_VERTEX_STORE_CL
#define PHLUX_VERTEX_STORE_CL

#include "transport/walk.cl"

#define VERTEX_WORDS (HAS_TANGENTS ? VERTEX_WORDS_MOST : HAS_SMOOTH_NORMALS ? VERTEX_TANGENT : VERTEX_GEOMETRIC)

typedef struct {
  __global Scalar* words;
  int rows;             // that there is room for
  __global int* first;  // per path: word 0 of its first vertex
  __global int* length; // and how many vertices it has
} VertexStore;

// Lanes of a subpath's vertices.
typedef struct {
  Int first, length;
} Trail;

static inline Trail no_trail(void) {
  Trail trail;
  trail.first = trail.length = (Int)(0);
  return trail;
}

#define ROW_WORDS (VERTEX_WORDS * LANES)

static inline void store_vec(__global Scalar* words, int word, Vec3 v) {
  store_scalars(words + word * LANES, v.x);
  store_scalars(words + (word + 1) * LANES, v.y);
  store_scalars(words + (word + 2) * LANES, v.z);
}
static inline Vec3 gather_vec(const __global Scalar* words, int word, Int at) {
  return vec3(gather_scalar(words + word * LANES, at), gather_scalar(words + (word + 1) * LANES, at),
              gather_scalar(words + (word + 2) * LANES, at));
}

static inline void store_vertex(const VertexStore* store, int row, const Walk* walk, Vertex v) {
  __global Scalar* words = store->words + (size_t)row * ROW_WORDS;
  store_vec(words, VERTEX_POSITION, v.point.position);
  store_vec(words, VERTEX_NORMAL, v.point.frame.z);
  store_vec(words, VERTEX_FIXED, vec_scale((Real)(-1.0f), walk->ray.direction));
  store_vec(words, VERTEX_THROUGHPUT, walk->throughput);
  store_scalars(words + VERTEX_ERROR * LANES, v.point.error);
  store_scalars(words + VERTEX_MATERIAL * LANES, carry_int(v.point.material));
  store_scalars(words + VERTEX_EDGE * LANES, walk->ratios.edge);
  store_scalars(words + VERTEX_REST * LANES, walk->ratios.rest);
  if (HAS_SMOOTH_NORMALS) store_vec(words, VERTEX_GEOMETRIC, v.point.normal);
  if (HAS_TANGENTS) store_vec(words, VERTEX_TANGENT, v.point.frame.x);
}

// A stored vertex, as far as connecting to it takes.
typedef struct {
  Vertex vertex;
  Vec3 throughput;
  Ratios ratios;
} Joint;

static inline Joint load_vertex(const Scene* scene, const VertexStore* store, Int at) {
  const __global Scalar* words = store->words;
  Joint j;
  j.vertex.point.position = gather_vec(words, VERTEX_POSITION, at);
  const Vec3 shading = gather_vec(words, VERTEX_NORMAL, at);
  if (HAS_TANGENTS) {
    j.vertex.point.frame.x = gather_vec(words, VERTEX_TANGENT, at);
    j.vertex.point.frame.y = vec_cross(shading, j.vertex.point.frame.x);
    j.vertex.point.frame.z = shading;
  } else {
    j.vertex.point.frame = frame_about(shading);
  }
  j.vertex.point.normal = HAS_SMOOTH_NORMALS ? gather_vec(words, VERTEX_GEOMETRIC, at) : shading;
  j.vertex.fixed = to_frame(j.vertex.point.frame, gather_vec(words, VERTEX_FIXED, at));
  j.vertex.point.error = gather_scalar(words + VERTEX_ERROR * LANES, at);
  j.vertex.material = material_at(scene, carried_int(gather_scalar(words + VERTEX_MATERIAL * LANES, at)));
  j.throughput = gather_vec(words, VERTEX_THROUGHPUT, at);
  j.ratios.edge = gather_scalar(words + VERTEX_EDGE * LANES, at);
  j.ratios.rest = gather_scalar(words + VERTEX_REST * LANES, at);
  return j;
}

// Where a subpath's vertices are, once it has ended.
static inline void store_trail(const VertexStore* store, Int path, Trail trail, Mask m) {
  scatter_int(store->first, path, trail.first, m);
  scatter_int(store->length, path, trail.length, m);
}
static inline Trail load_trail(const VertexStore* store, Int path) {
  Trail trail;
  trail.first = gather_int(store->first, path);
  trail.length = gather_int(store->length, path);
  return trail;
}

#endif
