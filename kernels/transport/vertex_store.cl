// The vertices of the subpaths of a batch in memory. The vertex of lane l in iteration t of the loop is in column l of
// row t, so that a row is written directly from registers. The vertices of a subpath are in consecutive rows of one
// column.
#ifndef PHLUX_VERTEX_STORE_CL
#define PHLUX_VERTEX_STORE_CL

#include "transport/lane_records.h"
#include "transport/subpath.cl"

// The data of a vertex that a connection needs.
typedef struct {
  Vec3 position, shading_normal;
  Vec3 back; // along the subpath, in world space
  Vec3 throughput;
  Real error;
  Int material; // its complement if the vertex is on the back of a surface (HAS_TRANSMISSION)
  MisQuantities mis;
  Vec3 normal;           // HAS_SMOOTH_NORMALS
  Vec3 tangent;          // HAS_TANGENTS
  TextureCoordinates uv; // HAS_TEXTURES
} VertexRecord;
#define VERTEX_FIELDS(VECTOR, NUMBER, INTEGER, UNSIGNED)                                                               \
  VECTOR(position)                                                                                                     \
  VECTOR(shading_normal)                                                                                               \
  VECTOR(back) VECTOR(throughput) NUMBER(error) INTEGER(material) NUMBER(mis.d_vcm) NUMBER(mis.d_vc)
#define VERTEX_FIELDS_OF_NORMALS(VECTOR, NUMBER, INTEGER, UNSIGNED) VECTOR(normal)
#define VERTEX_FIELDS_OF_TANGENTS(VECTOR, NUMBER, INTEGER, UNSIGNED) VECTOR(tangent)
#define VERTEX_FIELDS_OF_UV(VECTOR, NUMBER, INTEGER, UNSIGNED) NUMBER(uv.u) NUMBER(uv.v)
#define VERTEX_WORDS                                                                                                   \
  (RECORD_WORDS_OF(VERTEX_FIELDS) + (HAS_SMOOTH_NORMALS ? RECORD_WORDS_OF(VERTEX_FIELDS_OF_NORMALS) : 0) +             \
   (HAS_TANGENTS ? RECORD_WORDS_OF(VERTEX_FIELDS_OF_TANGENTS) : 0) +                                                   \
   (HAS_TEXTURES ? RECORD_WORDS_OF(VERTEX_FIELDS_OF_UV) : 0))
#define ROW_WORDS (VERTEX_WORDS * LANES)

typedef struct {
  __global Scalar* words;
  int rows;             // capacity
  __global int* first;  // per path: word 0 of its first vertex
  __global int* length; // per path: number of vertices
} VertexStore;

// The places of the vertices of the subpath of each lane.
typedef struct {
  Int first, length;
} StoredSubpath;

static inline StoredSubpath nothing_stored(void) {
  StoredSubpath stored;
  stored.first = stored.length = (Int)(0);
  return stored;
}

static inline void store_number(__global Scalar** words, Real v) {
  store_scalars(*words, v);
  *words += LANES;
}
static inline void store_vector(__global Scalar** words, Vec3 v) {
  store_number(words, v.x);
  store_number(words, v.y);
  store_number(words, v.z);
}
static inline Real gather_number(const __global Scalar** words, Int at) {
  const Real v = gather_scalar(*words, at);
  *words += LANES;
  return v;
}
static inline Vec3 gather_vector(const __global Scalar** words, Int at) {
  Vec3 v;
  v.x = gather_number(words, at);
  v.y = gather_number(words, at);
  v.z = gather_number(words, at);
  return v;
}

#define STORE_VECTOR(member) store_vector(&words, record.member);
#define STORE_NUMBER(member) store_number(&words, record.member);
#define STORE_INTEGER(member) store_number(&words, carry_int(record.member));

// Stores the vertices of all lanes in a row. In the lanes of `scattered` they are the next vertices of their subpaths;
// in the lanes of `starting` the subpaths begin with them.
static inline void store_vertices(const VertexStore* store, int row, const Subpath* s, Vertex v, StoredSubpath* stored,
                                  Mask starting, Mask scattered) {
  VertexRecord record;
  record.position = v.point.position;
  record.shading_normal = v.point.frame.z;
  record.back = vec_scale((Real)(-1.0f), s->ray.direction);
  record.throughput = s->throughput;
  record.error = v.point.error;
  record.material = HAS_TRANSMISSION ? (v.point.shaded_front ? v.point.material : ~v.point.material) : v.point.material;
  record.mis = s->mis;
  record.normal = v.point.normal;
  record.tangent = v.point.frame.x;
  record.uv = v.point.uv;
  __global Scalar* words = store->words + (size_t)row * ROW_WORDS;
  VERTEX_FIELDS(STORE_VECTOR, STORE_NUMBER, STORE_INTEGER, STORE_INTEGER)
  if (HAS_SMOOTH_NORMALS) {
    VERTEX_FIELDS_OF_NORMALS(STORE_VECTOR, STORE_NUMBER, STORE_INTEGER, STORE_INTEGER)
  }
  if (HAS_TANGENTS) {
    VERTEX_FIELDS_OF_TANGENTS(STORE_VECTOR, STORE_NUMBER, STORE_INTEGER, STORE_INTEGER)
  }
  if (HAS_TEXTURES) {
    VERTEX_FIELDS_OF_UV(STORE_VECTOR, STORE_NUMBER, STORE_INTEGER, STORE_INTEGER)
  }
  stored->first = starting ? row * ROW_WORDS + LANE_NUMBERS : stored->first;
  stored->length = starting ? (Int)(0) : stored->length;
  stored->length += scattered ? (Int)(1) : (Int)(0);
}

// A vertex as a connection needs it, made from its record.
typedef struct {
  Vertex vertex;
  Vec3 throughput;
  MisQuantities mis;
} StoredVertex;

#define GATHER_VECTOR(member) record.member = gather_vector(&words, at);
#define GATHER_NUMBER(member) record.member = gather_number(&words, at);
#define GATHER_INTEGER(member) record.member = carried_int(gather_number(&words, at));
static inline VertexRecord vertex_record_at(const VertexStore* store, Int at) {
  VertexRecord record;
  const __global Scalar* words = store->words;
  VERTEX_FIELDS(GATHER_VECTOR, GATHER_NUMBER, GATHER_INTEGER, GATHER_INTEGER)
  record.normal = record.tangent = record.shading_normal;
  record.uv.u = record.uv.v = (Real)(0.0f);
  if (HAS_SMOOTH_NORMALS) {
    VERTEX_FIELDS_OF_NORMALS(GATHER_VECTOR, GATHER_NUMBER, GATHER_INTEGER, GATHER_INTEGER)
  }
  if (HAS_TANGENTS) {
    VERTEX_FIELDS_OF_TANGENTS(GATHER_VECTOR, GATHER_NUMBER, GATHER_INTEGER, GATHER_INTEGER)
  }
  if (HAS_TEXTURES) {
    VERTEX_FIELDS_OF_UV(GATHER_VECTOR, GATHER_NUMBER, GATHER_INTEGER, GATHER_INTEGER)
  }
  return record;
}

static inline StoredVertex stored_vertex(const Scene* scene, const VertexStore* store, Int at) {
  const VertexRecord record = vertex_record_at(store, at);
  StoredVertex s;
  s.vertex.point.position = record.position;
  s.vertex.point.normal = record.normal;
  s.vertex.point.error = record.error;
  s.vertex.point.frame = frame_about(record.shading_normal);
  if (HAS_TANGENTS) {
    s.vertex.point.frame.x = record.tangent;
    s.vertex.point.frame.y = vec_cross(record.shading_normal, record.tangent);
  }
  s.vertex.fixed = to_frame(s.vertex.point.frame, record.back);
  const Mask front = HAS_TRANSMISSION ? (Mask)(record.material >= 0) : ALL_LANES;
  s.vertex.material = material_at(scene, front ? record.material : ~record.material, record.uv, front);
  s.throughput = record.throughput;
  s.mis = record.mis;
  return s;
}

// Records the places of the vertices of the subpaths of m, which have ended.
static inline void set_stored(const VertexStore* store, Int path, StoredSubpath stored, Mask m) {
  scatter_int(store->first, path, stored.first, m);
  scatter_int(store->length, path, stored.length, m);
}
static inline StoredSubpath stored_of(const VertexStore* store, Int path) {
  StoredSubpath stored;
  stored.first = gather_int(store->first, path);
  stored.length = gather_int(store->length, path);
  return stored;
}

#endif
