// The parts of a scene's program. The host defines each part as 0 or 1 (render::Parts); kernels use `if (HAS_SPHERES)`,
// and the compiler removes code that is never executed. The constants below follow from the parts.
#ifndef PHLUX_PARTS_H
#define PHLUX_PARTS_H

#include "lanes/lanes.h"

#define HAS_PLANARS (HAS_TRIANGLES | HAS_PARALLELOGRAMS | HAS_ELLIPSES)
#define HAS_MIXED_REGIONS (HAS_TRIANGLES + HAS_PARALLELOGRAMS + HAS_ELLIPSES > 1)

// If Mitsuba's strictNormals is false: only the interpolated normal determines on which side of a surface a direction
// is.
#define SIDES_BY_SHADING (HAS_SMOOTH_NORMALS & !HAS_STRICT_NORMALS)
// Directions that count may be on either side by the geometric normal.
#define HAS_SIGNED_COSINES (SIDES_BY_SHADING | HAS_TRANSMISSION)

#define HAS_BITMAPS (HAS_BYTE_TEXTURES | HAS_FLOAT_TEXTURES)
#define HAS_TEXTURES (HAS_CHECKERBOARDS | HAS_BITMAPS)

#define HAS_AREA_LIGHTS (HAS_PLANAR_LIGHTS | HAS_SPHERE_LIGHTS)
#define HAS_SKY (HAS_CONSTANT_LIGHT | HAS_ENVIRONMENT_MAP)
#define HAS_HITTABLE_LIGHTS (HAS_AREA_LIGHTS | HAS_SKY) // a ray can hit them
#define HAS_POINTLIKE_LIGHTS (HAS_POINT_LIGHTS | HAS_SPOT_LIGHTS)
#define LIGHT_KINDS                                                                                                    \
  (HAS_PLANAR_LIGHTS + HAS_SPHERE_LIGHTS + HAS_POINT_LIGHTS + HAS_SPOT_LIGHTS + HAS_DIRECTIONAL_LIGHTS + HAS_SKY)

// A table with few entries is kept in registers if the device can permute them (lanes/memory.h).
#define MATERIALS_IN_REGISTERS (LANES_PERMUTE & FEW_MATERIALS)
#define PRIMITIVES_IN_REGISTERS (LANES_PERMUTE & FEW_PRIMITIVES)
#define LIGHTS_IN_REGISTERS (LANES_PERMUTE & FEW_LIGHTS)

#endif
