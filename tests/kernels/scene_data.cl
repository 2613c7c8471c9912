#include "lanes/lanes.h"
#include "scene/scene_data.h"

__kernel void sizes(__global int* size) {
  int k = 0;
#define SIZE(type) size[k++] = (int)sizeof(type);
  SHARED_STRUCTS(SIZE)
}

// Offsets and sizes of the members in the first record of a table.
__kernel void offsets(__global char* memory, __global int* offset, __global int* size) {
  int k = 0;
#define OFFSET(type, member)                                                                                           \
  offset[k] = (int)((__global char*)&((__global type*)memory)->member - memory);                                       \
  size[k++] = (int)sizeof(((__global type*)memory)->member);
  SHARED_MEMBERS(OFFSET)
}
