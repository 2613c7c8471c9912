// The scene's tables as a kernel receives them. A table that a scene lacks is null, and no code reads it (parts.h).
#ifndef PHLUX_SCENE_CL
#define PHLUX_SCENE_CL

#include "math/vectors.h"
#include "scene/parts.h"
#include "scene/scene_data.h"

// 1 for a table that is not kept in registers, because an array has at least one entry.
#define MEMBERS_IN_REGISTERS(kept, members) ((kept) ? (members) : 1)

typedef struct {
  const __global CameraRecord* camera;
  const __global PrimitiveRecord* primitives;
  const __global float* materials; // records of MATERIAL_WORDS words each
  const __global LightRecord* lights;
  int light_count;
  const __global Scalar* planars;
  int triangle_end, parallelogram_end, ellipse_end; // brute force: regions come in this order
  const __global Scalar* spheres;
  int first_sphere, sphere_count; // first_sphere: primitive index of sphere 0
  const __global float* nodes;    // of the bounding volume hierarchy
  int root;
  const __global LightNodeRecord* light_nodes;
  float light_tree_probability; // with which light samples choose a light of the tree by power
  const __global EnvironmentRecord* environment;
  const __global EnvironmentTexel* environment_texels; // row by row
  const __global float* lobe_tables;                   // of the reflectance models
  const __global int* corners;          // three per flat primitive: indices into vertex_normals, -1: flat
  const __global float* vertex_normals; // three floats each
  const __global int* texture_numbers;  // like `materials`: 1 + a colour's texture at its first word, else 0
  const __global TextureRecord* textures;
  const __global float* texels;  // values of bytes, and texels
  const __global float* uv_maps; // UV_FLOATS per primitive
  // Copies of tables with few entries, member by member.
  float material_members[MEMBERS_IN_REGISTERS(MATERIALS_IN_REGISTERS, MATERIAL_WORDS)][TABLE_ENTRIES];
  float light_members[MEMBERS_IN_REGISTERS(LIGHTS_IN_REGISTERS, sizeof(LightRecord) / 4)][TABLE_ENTRIES];
  float primitive_members[MEMBERS_IN_REGISTERS(PRIMITIVES_IN_REGISTERS, sizeof(PrimitiveRecord) / 4)][TABLE_ENTRIES];
  float planar_members[MEMBERS_IN_REGISTERS(PRIMITIVES_IN_REGISTERS, PLANAR_FLOATS)][TABLE_ENTRIES];
  float sphere_members[MEMBERS_IN_REGISTERS(PRIMITIVES_IN_REGISTERS, SPHERE_FLOATS)][TABLE_ENTRIES];
} Scene;

// A member of an entry of a table, in every lane.
#define PRIMITIVE_INT(scene, index, member)                                                                            \
  (PRIMITIVES_IN_REGISTERS ? PERMUTE_INT((scene)->primitive_members, (scene)->primitives, index, member)               \
                           : GATHER_INT((scene)->primitives, index, member))
#define LIGHT_REAL(scene, index, member)                                                                               \
  (ONE_LIGHT             ? (Real)((scene)->lights[0].member)                                                           \
   : LIGHTS_IN_REGISTERS ? PERMUTE_REAL((scene)->light_members, (scene)->lights, index, member)                        \
                         : GATHER_REAL((scene)->lights, index, member))
#define LIGHT_INT(scene, index, member)                                                                                \
  (ONE_LIGHT             ? (Int)((scene)->lights[0].member)                                                            \
   : LIGHTS_IN_REGISTERS ? PERMUTE_INT((scene)->light_members, (scene)->lights, index, member)                         \
                         : GATHER_INT((scene)->lights, index, member))
#define LIGHT_VEC3(scene, index, member)                                                                               \
  vec3(LIGHT_REAL(scene, index, member[0]), LIGHT_REAL(scene, index, member[1]), LIGHT_REAL(scene, index, member[2]))

// Word `word` of a material's record, in every lane.
static inline Real material_real(const Scene* scene, Int index, int word) {
  return MATERIALS_IN_REGISTERS ? permute_real(scene->material_members[word], index)
                                : gather_real(scene->materials + word, index * MATERIAL_WORDS);
}
static inline Int material_int(const Scene* scene, Int index, int word) {
  return MATERIALS_IN_REGISTERS ? permute_int(scene->material_members[word], index)
                                : gather_int((const __global int*)scene->materials + word, index * MATERIAL_WORDS);
}

static inline Vec3 material_vec(const Scene* scene, Int index, int word) {
  return vec3(material_real(scene, index, word), material_real(scene, index, word + 1),
              material_real(scene, index, word + 2));
}

// Copies the tables that are kept in registers.
static inline void keep_small_tables(Scene* scene) {
  if (MATERIALS_IN_REGISTERS) load_members(scene->materials, MATERIAL_WORDS, scene->material_members);
  if (LIGHTS_IN_REGISTERS) load_members(scene->lights, sizeof(LightRecord) / 4, scene->light_members);
  if (PRIMITIVES_IN_REGISTERS) {
    load_members(scene->primitives, sizeof(PrimitiveRecord) / 4, scene->primitive_members);
    if (HAS_PLANARS) load_members(scene->planars, PLANAR_FLOATS, scene->planar_members);
    if (HAS_SPHERES) load_members(scene->spheres, SPHERE_FLOATS, scene->sphere_members);
  }
}

// The parameters of a kernel for the scene, and statements that copy them to a Scene named `scene`.
#define SCENE_PARAMETERS                                                                                               \
  const __global CameraRecord *camera, const __global PrimitiveRecord *primitives, const __global float *materials,    \
      const __global LightRecord *lights, int light_count, const __global Scalar *planars, int triangle_end,           \
      int parallelogram_end, int ellipse_end, const __global Scalar *spheres, int first_sphere, int sphere_count,      \
      const __global float *nodes, int root, const __global LightNodeRecord *light_nodes,                              \
      float light_tree_probability, const __global EnvironmentRecord *environment,                                     \
      const __global EnvironmentTexel *environment_texels, const __global float *lobe_tables,                          \
      const __global int *corners, const __global float *vertex_normals, const __global int *texture_numbers,          \
      const __global TextureRecord *textures, const __global float *texels, const __global float *uv_maps
#define SCENE_FROM_PARAMETERS                                                                                          \
  Scene scene;                                                                                                         \
  scene.camera = camera;                                                                                               \
  scene.primitives = primitives;                                                                                       \
  scene.materials = materials;                                                                                         \
  scene.lights = lights;                                                                                               \
  scene.light_count = light_count;                                                                                     \
  scene.planars = planars;                                                                                             \
  scene.triangle_end = triangle_end;                                                                                   \
  scene.parallelogram_end = parallelogram_end;                                                                         \
  scene.ellipse_end = ellipse_end;                                                                                     \
  scene.spheres = spheres;                                                                                             \
  scene.first_sphere = first_sphere;                                                                                   \
  scene.sphere_count = sphere_count;                                                                                   \
  scene.nodes = nodes;                                                                                                 \
  scene.root = root;                                                                                                   \
  scene.light_nodes = light_nodes;                                                                                     \
  scene.light_tree_probability = light_tree_probability;                                                               \
  scene.environment = environment;                                                                                     \
  scene.environment_texels = environment_texels;                                                                       \
  scene.lobe_tables = lobe_tables;                                                                                     \
  scene.corners = corners;                                                                                             \
  scene.vertex_normals = vertex_normals;                                                                               \
  scene.texture_numbers = texture_numbers;                                                                             \
  scene.textures = textures;                                                                                           \
  scene.texels = texels;                                                                                               \
  scene.uv_maps = uv_maps;                                                                                             \
  keep_small_tables(&scene);

#endif
