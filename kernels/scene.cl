// The scene's tables as a kernel receives them. A part (PHLUX_...) that the scene lacks has no table and no code.
// render::DeviceScene::bind sets the arguments in this order.
#ifndef PHLUX_SCENE_CL
#define PHLUX_SCENE_CL

#include "scene_data.h"
#include "vectors.h"

// A scene with few of something keeps that table in registers' reach (lanes.h).
#ifdef LANES_PERMUTE
#ifdef PHLUX_FEW_MATERIALS
#define MATERIALS_AT_HAND
#endif
#ifdef PHLUX_FEW_PRIMITIVES
#define PRIMITIVES_AT_HAND
#endif
#ifdef PHLUX_FEW_LIGHTS
#define LIGHTS_AT_HAND
#endif
#endif

typedef struct {
  const __global CameraRecord* camera;
  const __global PrimitiveRecord* primitives;
  const __global MaterialRecord* materials;
  const __global LightRecord* lights;
  int light_count;
#ifdef PHLUX_PLANARS
  const __global Scalar* planars;
  int triangle_end, parallelogram_end, ellipse_end; // brute force: regions come in this order
#endif
#ifdef PHLUX_SPHERES
  const __global Scalar* spheres;
  int first_sphere, sphere_count; // first_sphere: primitive index of sphere 0
#endif
#ifdef PHLUX_BVH
  const __global float* nodes;
  int root;
#endif
#ifdef PHLUX_LIGHT_TREE
  const __global LightNodeRecord* light_nodes;
  float light_tree_probability; // with which choose_light gives one of its lights
#endif
#ifdef PHLUX_PHONG_LOBE
  const __global float* reflectivity;
#endif
#ifdef PHLUX_SMOOTH_NORMALS
  const __global int* corners;          // three per flat primitive: indices into vertex_normals, -1: flat
  const __global float* vertex_normals; // three floats each
#endif
#ifdef MATERIALS_AT_HAND
  float material_members[sizeof(MaterialRecord) / 4][LANES];
#endif
#ifdef LIGHTS_AT_HAND
  float light_members[sizeof(LightRecord) / 4][LANES];
#endif
#ifdef PRIMITIVES_AT_HAND
  float primitive_members[sizeof(PrimitiveRecord) / 4][LANES];
#ifdef PHLUX_PLANARS
  float planar_members[PLANAR_FLOATS][LANES];
#endif
#ifdef PHLUX_SPHERES
  float sphere_members[SPHERE_FLOATS][LANES];
#endif
#endif
} Scene;

// The member of an entry of a table, in every lane.
#ifdef MATERIALS_AT_HAND
#define MATERIAL_REAL(scene, index, member) PERMUTE_REAL((scene)->material_members, (scene)->materials, index, member)
#define MATERIAL_INT(scene, index, member) PERMUTE_INT((scene)->material_members, (scene)->materials, index, member)
#else
#define MATERIAL_REAL(scene, index, member) GATHER_REAL((scene)->materials, index, member)
#define MATERIAL_INT(scene, index, member) GATHER_INT((scene)->materials, index, member)
#endif
#ifdef PRIMITIVES_AT_HAND
#define PRIMITIVE_INT(scene, index, member) PERMUTE_INT((scene)->primitive_members, (scene)->primitives, index, member)
#else
#define PRIMITIVE_INT(scene, index, member) GATHER_INT((scene)->primitives, index, member)
#endif
#if defined(PHLUX_ONE_LIGHT)
#define LIGHT_REAL(scene, index, member) ((void)(index), (Real)((scene)->lights[0].member))
#define LIGHT_INT(scene, index, member) ((void)(index), (Int)((scene)->lights[0].member))
#elif defined(LIGHTS_AT_HAND)
#define LIGHT_REAL(scene, index, member) PERMUTE_REAL((scene)->light_members, (scene)->lights, index, member)
#define LIGHT_INT(scene, index, member) PERMUTE_INT((scene)->light_members, (scene)->lights, index, member)
#else
#define LIGHT_REAL(scene, index, member) GATHER_REAL((scene)->lights, index, member)
#define LIGHT_INT(scene, index, member) GATHER_INT((scene)->lights, index, member)
#endif
#define MATERIAL_VEC3(scene, index, member)                                                                            \
  vec3(MATERIAL_REAL(scene, index, member[0]), MATERIAL_REAL(scene, index, member[1]),                                 \
       MATERIAL_REAL(scene, index, member[2]))
#define LIGHT_VEC3(scene, index, member)                                                                               \
  vec3(LIGHT_REAL(scene, index, member[0]), LIGHT_REAL(scene, index, member[1]), LIGHT_REAL(scene, index, member[2]))

#ifdef PHLUX_PLANARS
#define SCENE_PLANAR_PARAMETERS                                                                                        \
  , const __global Scalar *planars, int triangle_end, int parallelogram_end, int ellipse_end
#define SCENE_PLANAR_SET                                                                                               \
  scene.planars = planars;                                                                                             \
  scene.triangle_end = triangle_end;                                                                                   \
  scene.parallelogram_end = parallelogram_end;                                                                         \
  scene.ellipse_end = ellipse_end;
#else
#define SCENE_PLANAR_PARAMETERS
#define SCENE_PLANAR_SET
#endif
#ifdef PHLUX_SPHERES
#define SCENE_SPHERE_PARAMETERS , const __global Scalar *spheres, int first_sphere, int sphere_count
#define SCENE_SPHERE_SET                                                                                               \
  scene.spheres = spheres;                                                                                             \
  scene.first_sphere = first_sphere;                                                                                   \
  scene.sphere_count = sphere_count;
#else
#define SCENE_SPHERE_PARAMETERS
#define SCENE_SPHERE_SET
#endif
#ifdef PHLUX_BVH
#define SCENE_BVH_PARAMETERS , const __global float *nodes, int root
#define SCENE_BVH_SET                                                                                                  \
  scene.nodes = nodes;                                                                                                 \
  scene.root = root;
#else
#define SCENE_BVH_PARAMETERS
#define SCENE_BVH_SET
#endif
#ifdef PHLUX_LIGHT_TREE
#define SCENE_LIGHT_TREE_PARAMETERS , const __global LightNodeRecord *light_nodes, float light_tree_probability
#define SCENE_LIGHT_TREE_SET                                                                                           \
  scene.light_nodes = light_nodes;                                                                                     \
  scene.light_tree_probability = light_tree_probability;
#else
#define SCENE_LIGHT_TREE_PARAMETERS
#define SCENE_LIGHT_TREE_SET
#endif
#ifdef PHLUX_PHONG_LOBE
#define SCENE_LOBE_PARAMETERS , const __global float* reflectivity
#define SCENE_LOBE_SET scene.reflectivity = reflectivity;
#else
#define SCENE_LOBE_PARAMETERS
#define SCENE_LOBE_SET
#endif
#ifdef PHLUX_SMOOTH_NORMALS
#define SCENE_NORMAL_PARAMETERS , const __global int *corners, const __global float *vertex_normals
#define SCENE_NORMAL_SET                                                                                               \
  scene.corners = corners;                                                                                             \
  scene.vertex_normals = vertex_normals;
#else
#define SCENE_NORMAL_PARAMETERS
#define SCENE_NORMAL_SET
#endif

#ifdef MATERIALS_AT_HAND
#define SCENE_MATERIALS_LOAD load_members(materials, sizeof(MaterialRecord) / 4, scene.material_members);
#else
#define SCENE_MATERIALS_LOAD
#endif
#ifdef LIGHTS_AT_HAND
#define SCENE_LIGHTS_LOAD load_members(lights, sizeof(LightRecord) / 4, scene.light_members);
#else
#define SCENE_LIGHTS_LOAD
#endif
#ifdef PRIMITIVES_AT_HAND
#define SCENE_PRIMITIVES_LOAD load_members(primitives, sizeof(PrimitiveRecord) / 4, scene.primitive_members);
#else
#define SCENE_PRIMITIVES_LOAD
#endif
#if defined(PRIMITIVES_AT_HAND) && defined(PHLUX_PLANARS)
#define SCENE_PLANARS_LOAD load_members(planars, PLANAR_FLOATS, scene.planar_members);
#else
#define SCENE_PLANARS_LOAD
#endif
#if defined(PRIMITIVES_AT_HAND) && defined(PHLUX_SPHERES)
#define SCENE_SPHERES_LOAD load_members(spheres, SPHERE_FLOATS, scene.sphere_members);
#else
#define SCENE_SPHERES_LOAD
#endif

// A kernel's parameters for the scene, and the statement that gathers them in a Scene named `scene`.
#define SCENE_PARAMETERS                                                                                               \
  const __global CameraRecord *camera, const __global PrimitiveRecord *primitives,                                     \
      const __global MaterialRecord *materials, const __global LightRecord *lights,                                    \
      int light_count SCENE_PLANAR_PARAMETERS SCENE_SPHERE_PARAMETERS SCENE_BVH_PARAMETERS SCENE_LIGHT_TREE_PARAMETERS \
          SCENE_LOBE_PARAMETERS SCENE_NORMAL_PARAMETERS
#define SCENE_FROM_PARAMETERS                                                                                          \
  Scene scene;                                                                                                         \
  scene.camera = camera;                                                                                               \
  scene.primitives = primitives;                                                                                       \
  scene.materials = materials;                                                                                         \
  scene.lights = lights;                                                                                               \
  scene.light_count = light_count;                                                                                     \
  SCENE_PLANAR_SET SCENE_SPHERE_SET SCENE_BVH_SET SCENE_LIGHT_TREE_SET SCENE_LOBE_SET SCENE_NORMAL_SET                 \
      SCENE_MATERIALS_LOAD SCENE_LIGHTS_LOAD SCENE_PRIMITIVES_LOAD SCENE_PLANARS_LOAD SCENE_SPHERES_LOAD

#endif
