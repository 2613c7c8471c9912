// The scene's tables as a kernel receives them. A part (PHLUX_...) that the scene lacks has no table and no code.
// render::DeviceScene::bind sets the arguments in this order.
#ifndef PHLUX_SCENE_CL
#define PHLUX_SCENE_CL

#include "lanes.h"
#include "scene_data.h"

typedef struct {
  const __global CameraRecord* camera;
  const __global PrimitiveRecord* primitives;
  const __global MaterialRecord* materials;
  const __global LightRecord* lights;
  int light_count;
#ifdef PHLUX_PLANARS
  const __global float* planars;
  int triangle_end, parallelogram_end, ellipse_end; // brute force: regions come in this order
#endif
#ifdef PHLUX_SPHERES
  const __global float* spheres;
  int first_sphere, sphere_count; // first_sphere: primitive index of sphere 0
#endif
#ifdef PHLUX_BVH
  const __global float* nodes;
  int root;
#endif
#ifdef PHLUX_PHONG_LOBE
  const __global float* reflectivity;
#endif
#ifdef PHLUX_SMOOTH_NORMALS
  const __global int* corners;          // three per flat primitive: indices into vertex_normals, -1: flat
  const __global float* vertex_normals; // three floats each
#endif
} Scene;

#ifdef PHLUX_PLANARS
#define SCENE_PLANAR_PARAMETERS                                                                                        \
  , const __global float *planars, int triangle_end, int parallelogram_end, int ellipse_end
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
#define SCENE_SPHERE_PARAMETERS , const __global float *spheres, int first_sphere, int sphere_count
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

// A kernel's parameters for the scene, and the statement that gathers them in a Scene named `scene`.
#define SCENE_PARAMETERS                                                                                               \
  const __global CameraRecord *camera, const __global PrimitiveRecord *primitives,                                     \
      const __global MaterialRecord *materials, const __global LightRecord *lights,                                    \
      int light_count SCENE_PLANAR_PARAMETERS SCENE_SPHERE_PARAMETERS SCENE_BVH_PARAMETERS SCENE_LOBE_PARAMETERS       \
          SCENE_NORMAL_PARAMETERS
#define SCENE_FROM_PARAMETERS                                                                                          \
  Scene scene;                                                                                                         \
  scene.camera = camera;                                                                                               \
  scene.primitives = primitives;                                                                                       \
  scene.materials = materials;                                                                                         \
  scene.lights = lights;                                                                                               \
  scene.light_count = light_count;                                                                                     \
  SCENE_PLANAR_SET SCENE_SPHERE_SET SCENE_BVH_SET SCENE_LOBE_SET SCENE_NORMAL_SET

#endif
