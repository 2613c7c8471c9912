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
// Sides that reflect anything, neither if the material is black; whether light passes through; whether a colour is from a
// texture; whether its opacity is below 1.
enum MaterialFlags {
  MATERIAL_FRONT = 1,
  MATERIAL_BACK = 2,
  MATERIAL_TRANSMITS = 4,
  MATERIAL_TEXTURED = 8,
  MATERIAL_MASKED = 16
};
// The opacity of a masked material, at the end of the record of a scene that has some.
enum { MATERIAL_OPACITY_WORDS = 3 };
#define MATERIAL_OPACITY (MATERIAL_WORDS - MATERIAL_OPACITY_WORDS)

// A texture: a colour at (u, v) = to_uv (1, its surface's u and v).
enum TextureKinds { TEXTURE_CHECKERBOARD = 0, TEXTURE_BYTES = 1, TEXTURE_FLOATS = 2 };
enum TextureWraps { WRAP_REPEAT = 0, WRAP_MIRROR = 1, WRAP_CLAMP = 2 };
typedef struct {
  int kind;        // enum TextureKinds
  float to_uv[6];  // u and v of the lookup: each the factors of the surface's u and v, and a summand
  float colors[6]; // checkerboard: its two colours; bitmap: colors[0] is a factor of every texel
  // Bitmaps: row 0 is at v = 0.
  int width, height;
  int wrap_u, wrap_v; // enum TextureWraps
  int nearest;        // 1: no interpolation
  int first_word;     // in the table of texels. Bytes: one word per texel, red in its lowest byte; floats: three
  int decoding;       // bytes: the word where the linear values of the 256 bytes begin
} TextureRecord;

// What a primitive's texture coordinates and tangents follow from. Flat, with a and b along edge_u and edge_v:
// origin + a per_u + b per_v (of ellipses its polar coordinates, radius and turns), and d position / d u (not of
// ellipses). Spheres: the directions of the object's x, y and z axes.
enum UvValues { UV_ORIGIN = 0, UV_PER_U = 2, UV_PER_V = 4, UV_TANGENT = 6, UV_AXES = 0, UV_FLOATS = 9 };

enum LightKinds {
  LIGHT_PLANAR = 0,
  LIGHT_SPHERE = 1,
  LIGHT_POINT = 2,
  LIGHT_SPOT = 3,
  LIGHT_DIRECTIONAL = 4,
  LIGHT_SKY = 5 // constant, or the environment map
};

// One light: an emitting primitive, or a light without a surface. Selected with the alias method (Walker 1974; Vose
// 1991): cell i gives light i with probability `alias_threshold`, else light `alias`.
typedef struct {
  int kind;          // enum LightKinds
  int primitive;     // planar, sphere: index of the primitive
  float radiance[3]; // of area lights and a constant sky, the largest of an environment map; intensity of point and
                     // spot, irradiance of directional lights
  float area;        // planar, sphere: m^2; directional, sky: of the disk across the scene
  float position[3];
  float direction[3];
  float cutoff, inv_transition; // spot: cutoff and 1 / (cutoff - beam width) in radians
  float probability;            // of being selected
  // Of a light path's first edge, the selection included: per area and projected solid angle (planar, sphere), per
  // solid angle (point, spot), per area (directional, environment map), per both (constant sky).
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

// An environment map in its own frame (as Mitsuba's): the texel in column (phi / (2 pi)) width and row (theta / pi)
// height lies towards sin(theta) sin(phi) x + cos(theta) y - sin(theta) cos(phi) z.
typedef struct {
  float x[3], y[3], z[3]; // its axes in the world, orthonormal
  float density;          // per solid angle and sum of the channels, of a sampled direction
  float cap;              // 1 - cos(theta) at the centre of the first row
  float cap_share;        // of the samples of a texel at a pole, those that are beyond its centre
  int width, height;
} EnvironmentRecord;

// A texel, and the cell of the alias method with its index: texel i with probability threshold / 2^32, else `alias`.
typedef struct {
  float radiance[3];
  unsigned int threshold;
  int alias;
} EnvironmentTexel;

// The camera. The direction through film position (x, y) in [0, 1]^2, y downwards, is
// forward + (1 - 2 (x + principal_x)) left + (1 - 2 (y + principal_y)) up, not normalised; HAS_ORTHOGRAPHIC: rays along
// forward start at position + (1 - 2 (x + principal_x)) left + (1 - 2 (y + principal_y)) up.
typedef struct {
  float position[3];
  float forward[3], left[3], up[3]; // left and up carry the tangents of half the fields of view, or half the film
  float principal_x, principal_y;
  float film_area; // of the whole film on the plane at distance 1
  float lens[2];   // HAS_LENS: its radius in lengths of left and up
  float inv_focus_distance;
  float filter_size; // pixels: radius of the tent, standard deviation of the Gaussian
  int width, height;
} CameraRecord;

// What a device hands over for a job (film::BlockSum): sums over its samples of radiance, of its squares, of what was
// not finite and of what clamping took away.
enum SumWords { SUM_RADIANCE = 0, SUM_SQUARES = 3, SUM_NONFINITE = 6, SUM_CLAMPED = 7, SUM_WORDS = 8 };

// What a device hands over for a pixel's first hits (film::FirstHit).
enum FeatureWords { FEATURE_ALBEDO = 0, FEATURE_NORMAL = 3, FEATURE_DEPTH = 6, FEATURE_WORDS = 7 };

// A record of a splat: arrays of one word each. The last two only where each technique is wanted by itself; the
// technique is then s << 16 | t, its complement where the path adds to its own pixel, and the value is without its
// weight.
enum RecordWords { RECORD_PIXEL = 0, RECORD_PATH, RECORD_VALUE, RECORD_WEIGHT = 5, RECORD_TECHNIQUE };

// Words of a stored vertex (transport/vertex_store.cl): of a scene without interpolated normals, tangents and textures,
// and what each of these adds.
enum VertexWords {
  VERTEX_WORDS_PLAIN = 16,
  VERTEX_WORDS_OF_NORMAL = 3,
  VERTEX_WORDS_OF_TANGENT = 3,
  VERTEX_WORDS_OF_UV = 2
};

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
