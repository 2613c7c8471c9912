// The tables that the host writes and the kernels read, in types with the same layout for both compilers: only 4-byte
// floats and ints. Included by host code and by kernels.
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
  REGION_NONE = 3           // fills a block; never hit
};

// Values of CONNECT: path tracing finds light by hits, by light samples, or by both with weights.
#define CONNECT_NONE 0
#define CONNECT_LIGHT 1
#define CONNECT_MIS 2

// Spheres, in blocks like the flat primitives.
enum SphereValues { SPHERE_CENTER = 0, SPHERE_RADIUS = 3, SPHERE_FLOATS = 4 };

// References of a primitive. Flat primitives come first, then spheres.
typedef struct {
  int material;
  int light;  // index of its LightRecord; -1: it emits nothing
  int region; // flat: enum PlanarRegions; sphere: 1 if the front side is inside; both: REGION_NONE
} PrimitiveRecord;

// A material's record: a header, then the words of its model's parameters (lobes/lobe.h). The host defines
// MATERIAL_WORDS, the length of the longest record of the scene.
enum MaterialHeader { MATERIAL_MODEL = 0, MATERIAL_FLAGS = 1, MATERIAL_HEADER = 2 };
// Flags: the sides that reflect light (none if the material is black); whether the material transmits light; whether a
// colour is from a texture; whether the opacity is below 1.
enum MaterialFlags {
  MATERIAL_FRONT = 1,
  MATERIAL_BACK = 2,
  MATERIAL_TRANSMITS = 4,
  MATERIAL_TEXTURED = 8,
  MATERIAL_MASKED = 16
};
// The opacity of a masked material, at the end of every record if the scene has masks.
enum { MATERIAL_OPACITY_WORDS = 3 };
#define MATERIAL_OPACITY (MATERIAL_WORDS - MATERIAL_OPACITY_WORDS)

// A texture: a colour at (u, v), which are affine functions of the u and v of the surface.
enum TextureKinds { TEXTURE_CHECKERBOARD = 0, TEXTURE_BYTES = 1, TEXTURE_FLOATS = 2 };
enum TextureWraps { WRAP_REPEAT = 0, WRAP_MIRROR = 1, WRAP_CLAMP = 2 };
typedef struct {
  int kind;        // enum TextureKinds
  float to_uv[6];  // for u and for v of the lookup: the factors of the surface's u and v, and a constant
  float colors[6]; // checkerboard: its two colours; bitmap: colors[0] is a factor of all texels
  // Bitmaps: row 0 is at v = 0.
  int width, height;
  int wrap_u, wrap_v; // enum TextureWraps
  int nearest;        // 1: no interpolation
  int first_word;     // in the table of texels. Bytes: one word per texel, red in its lowest byte; floats: three
  int decoding;       // bytes: first word of the linear values of the 256 bytes
} TextureRecord;

// Data for the texture coordinates and tangents of a primitive. Flat, with a and b along edge_u and edge_v: (u, v) =
// origin + a per_u + b per_v (for ellipses the polar coordinates of this, radius and turns), and d position / d u (not
// for ellipses). Spheres: the directions of the x, y and z axes of the object.
enum UvValues { UV_ORIGIN = 0, UV_PER_U = 2, UV_PER_V = 4, UV_TANGENT = 6, UV_AXES = 0, UV_FLOATS = 9 };

enum LightKinds {
  LIGHT_PLANAR = 0,
  LIGHT_SPHERE = 1,
  LIGHT_POINT = 2,
  LIGHT_SPOT = 3,
  LIGHT_DIRECTIONAL = 4,
  LIGHT_SKY = 5 // constant, or the environment map
};

// One light: an emitting primitive, or a light without a surface. The sky is the last. Lights other than the sky are
// selected with the alias method (Walker 1974; Vose 1991): cell i gives light i with probability `alias_threshold`,
// else light `alias`.
typedef struct {
  int kind;          // enum LightKinds
  int primitive;     // planar, sphere: index of the primitive
  float radiance[3]; // of area lights and a constant sky; largest one of an environment map; intensity of point and
                     // spot lights; irradiance of directional lights
  float area;        // planar, sphere: m^2; directional, sky: of the disk that covers the scene
  float position[3];
  float direction[3];
  float cutoff, inv_transition; // spot: cutoff and 1 / (cutoff - beam width) in radians
  float probability;            // of the selection for a light path
  float sample_probability;     // of the selection by power for a light sample
  // Density of the first edge of a light path, including the selection: per area and projected solid angle (planar,
  // sphere), per solid angle (point, spot), per area (directional, environment map), per area and solid angle
  // (constant).
  float emission_density;
  float alias_threshold;
  int alias;
  int node; // its leaf in the tree of lights; -1: it is not in the tree
} LightRecord;

// A node of the tree of lights (light_tree.cl). Node 0 is the root; siblings are 2 k and 2 k + 1 for k > 0; node 1 is
// not used.
typedef struct {
  float center[3], half_size[3]; // of a box that contains the lights of the node
  float axis[3], cos_spread;     // of a cone that contains their normals; cos_spread -1: any direction
  float intensity;               // sum of the largest intensities of the lights in any direction; 1 for the whole tree
  int parent;
  int child; // the first of two; a leaf: ~light
} LightNodeRecord;

// An environment map in its own frame (as Mitsuba's): the texel in column (phi / (2 pi)) width and row (theta / pi)
// height is in the direction sin(theta) sin(phi) x + cos(theta) y - sin(theta) cos(phi) z.
typedef struct {
  float x[3], y[3], z[3]; // its axes in the world, orthonormal
  float density;          // density of a sampled direction, per solid angle, divided by the sum of the channels
  float cap;              // 1 - cos(theta) at the centre of the first row
  float cap_share;        // fraction of the samples of a texel at a pole that are between its centre and the pole
  int width, height;
} EnvironmentRecord;

// A texel i, and its cell of the alias method: texel i with probability threshold / 2^32, else `alias`.
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
  float forward[3], left[3], up[3]; // lengths of left and up: tan(field of view / 2), or half the size of the film
  float principal_x, principal_y;
  float film_area; // of the whole film on the plane at distance 1
  float lens[2];   // HAS_LENS: its radius in units of left and up
  float inv_focus_distance;
  float filter_size; // pixels: radius of the tent, standard deviation of the Gaussian
  int width, height;
} CameraRecord;

// The result of a job (film::BlockSum): sums over its samples of radiance, of its squares, of the number of samples
// that were not finite, and of the radiance that clamping removed.
enum SumWords { SUM_RADIANCE = 0, SUM_SQUARES = 3, SUM_NONFINITE = 6, SUM_CLAMPED = 7, SUM_WORDS = 8 };

// The result of the first hits of a pixel (film::FirstHit): means, then the variances of these means.
enum FeatureWords {
  FEATURE_ALBEDO = 0,
  FEATURE_NORMAL = 3,
  FEATURE_DEPTH = 6,
  FEATURE_VARIANCES = 7,
  FEATURE_WORDS = 14
};

// A record of a splat, with one array for each word. The last two words exist only if techniques are recorded
// separately: the technique s << 16 | t, or its complement if the path adds to its own pixel, and the weight, which the
// value then does not include.
enum RecordWords { RECORD_PIXEL = 0, RECORD_PATH, RECORD_VALUE, RECORD_WEIGHT = 5, RECORD_TECHNIQUE };

// Numbers of words of a stored vertex (transport/vertex_store.cl): without interpolated normals, tangents and textures,
// and the additional words of each of these.
enum VertexWords {
  VERTEX_WORDS_PLAIN = 16,
  VERTEX_WORDS_OF_NORMAL = 3,
  VERTEX_WORDS_OF_TANGENT = 3,
  VERTEX_WORDS_OF_UV = 2
};

// Words of a bidirectional path in addition to its vertices: the places of the vertices of both subpaths, and radiance.
enum { SCRATCH_WORDS_PER_PATH = 8 };

// The kind of the primitives in a leaf of the hierarchy: one of PlanarRegions, or spheres.
enum { LEAF_SPHERES = 3 };

// One node of the hierarchy: the boxes of CHILDREN children, then the children. A child >= 0 is a node; one < 0 is a
// leaf: ~child = first block << 5 | (blocks - 1) << 2 | kind. A leaf has at most 8 blocks.
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
