// scene_intersect and scene_occluded, by whichever traversal suits the scene: exactly one of these files is not empty.
#include "traverse_brute.cl"
#include "traverse_bvh.cl"
