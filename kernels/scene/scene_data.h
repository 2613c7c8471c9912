// The tables that the host writes and the kernels read, in types that both compilers lay out alike: 4-byte floats and
// ints only, no vectors. Included by host code and by kernels.
#ifndef PHLUX_SCENE_DATA_H
#define PHLUX_SCENE_DATA_H

// A flat primitive is {origin + u edge_u + v edge_v} over a region of (u, v). Twelve floats, stored as blocks of BLOCK
// primitives: value k of primitive i is at [(i / BLOCK) * 12 * BLOCK + k * BLOCK + i % BLOCK].
enum PlanarValues {
  PLANAR_ORIGIN = 0,  // origin
  PLANAR_EDGE_V = 3,  // edge_v / |edge_u x edge_v|
  PLANAR_MINUS_U = 6, // -edge_u / |edge_u x edge_v|
  PLANAR_NORMAL = 9,  // unit, front side
  PLANAR_FLOATS = 12
};

enum PlanarRegions {
  REGION_TRIANGLE = 0,      // u >= 0, v >= 0, u + v <= 1; origin is a vertex
  REGION_PARALLELOGRAM = 1, // |u| <= 1, |v| <= 1; origin is the centre
  REGION_ELLIPSE = 2,       // u^2 + v^2 <= 1; origin is the centre
  REGION_NONE = 3           // fills up a block: never hit
};

// CONNECT: how path tracing reaches the lights, by hits, by light samples, or by both with weights.
#define CONNECT_NONE 0
#define CONNECT_LIGHT 1
#define CONNECT_MIS 2

// Spheres, in blocks like the flat primitives.
enum SphereValues { SPHERE_CENTER = 0, SPHERE_RADIUS = 3, SPHERE_FLOATS = 4 };

// What a primitive refers to. Flat primitives come first, then spheres.
typedef struct {
  int material;
  int light;  // index of its LightRecord, -1: emits nothing
  int region; // flat: enum PlanarRegions; sphere: 1 where the front side is inside; both: REGION_NONE
} PrimitiveRecord;

// A material's record: a header, then the words of its model's parameters (lobes/lobe.h). The host defines
// MATERIAL_WORDS, the length of the longest record of the scene.
enum MaterialHeader { MATERIAL_MODEL = 0, MATERIAL_FLAGS = 1, MATERIAL_HEADER = 2 };
// Sides that reflect anything, neither if the material is black; and whether light passes through.
enum MaterialFlags { MATERIAL_FRONT = 1, MATERIAL_BACK = 2, MATERIAL_TRANSMITS = 4 };

enum LightKinds {
  LIGHT_PLANAR = 0,
  LIGHT_SPHERE = 1,
  LIGHT_POINT = 2,
  LIGHT_SPOT = 3,
  LIGHT_DIRECTIONAL = 4,
  LIGHT_CONSTANT = 5
};

// One light: an emitting primitive, or a light without a surface. Selected with the alias method (Walker 1974; Vose
// 1991): cell i gives light i with probability `alias_threshold`, else light `alias`.
typedef struct {
  int kind;       // enum LightKinds
  int primitive;  // planar, sphere: index of the primitive
  float radiance[3]; // of area and constant lights; intensity of point and spot, irradiance of directional lights
  float area;     // planar, sphere: m^2; directional, constant: of the disk across the scene
  float position[3];
  float direction[3];
  float cutoff, inv_transition; // spot: cutoff and 1 / (cutoff - beam width) in radians
  float probability;            // of being selected
  // Of a light path's first edge, the selection included: per area and projected solid angle (planar, sphere), per
  // solid angle (point, spot), per area (directional), per both (constant).
  float emission_density;
  float alias_threshold;
  int alias;
  int node; // its leaf in the tree of lights; -1: not in it
} LightRecord;

// A node of the tree of lights (light_tree.cl). Node 0 is the root; siblings are 2 k and 2 k + 1, for k > 0; there is
// no node 1.
typedef struct {
  float center[3], half_size[3]; // of a box that holds the node's lights
  float axis[3], cos_spread;     // of a cone that holds their normals; cos_spread -1: any direction
  float intensity;               // the sum of the most that each sends in any direction, the tree's being 1
  int parent;
  int child; // the first of two; a leaf: ~light
} LightNodeRecord;

// The pinhole: the direction through film position (x, y) in [0, 1]^2, y downwards, is
// forward + (1 - 2 (x + principal_x)) left + (1 - 2 (y + principal_y)) up, not normalised.
typedef struct {
  float position[3];
  float forward[3], left[3], up[3]; // left and up carry the tangents of half the fields of view
  float principal_x, principal_y;
  float film_area; // of the whole film on the plane at distance 1
  int width, height;
} CameraRecord;

// What a device hands over for a job (film::BlockSum): sums over its samples of radiance, of its squares, of what was
// not finite and of what clamping took away.
enum SumWords { SUM_RADIANCE = 0, SUM_SQUARES = 3, SUM_NONFINITE = 6, SUM_CLAMPED = 7, SUM_WORDS = 8 };

// A record of a splat: arrays of one word each. The last two only where each technique is wanted by itself; the
// technique is then s << 16 | t, its complement where the path adds to its own pixel, and the value is without its
// weight.
enum RecordWords { RECORD_PIXEL = 0, RECORD_PATH, RECORD_VALUE, RECORD_WEIGHT = 5, RECORD_TECHNIQUE };

// Words of a stored vertex (transport/vertex_store.cl): of a scene without interpolated normals and tangents, and what
// each of these adds.
enum VertexWords { VERTEX_WORDS_PLAIN = 16, VERTEX_WORDS_OF_NORMAL = 3, VERTEX_WORDS_OF_TANGENT = 3 };

// What a batch of bidirectional paths needs for each path besides vertices: where the two subpaths' are, and radiance.
enum { SCRATCH_WORDS_PER_PATH = 8 };

// One node of the hierarchy: the boxes of CHILDREN children, then the children. A child >= 0 is a node; one < 0 is a
// leaf: ~child = first block << 5 | (blocks - 1) << 1 | (1 where the blocks hold spheres).
enum NodeValues {
  NODE_LOW_X = 0,
  NODE_LOW_Y,
  NODE_LOW_Z,
  NODE_HIGH_X,
  NODE_HIGH_Y,
  NODE_HIGH_Z,
  NODE_CHILD,
  NODE_WORDS
};

#endif
