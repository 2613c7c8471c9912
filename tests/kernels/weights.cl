#include "transport/mis_weights.cl"

// A path from x_0 (on a light) to x_edges (the eye), given by densities (per solid angle) and cosines at its
// vertices: `forward` is that of the direction to the next vertex for a path that comes from the light,
// `backward` that of the direction to the one before for a path that comes from the eye. Cosines are of the
// edge before and the one after.
#define MOST_EDGES 8
typedef struct {
  Real forward[MOST_EDGES + 1], backward[MOST_EDGES + 1], cosine_before[MOST_EDGES + 1],
      cosine_after[MOST_EDGES + 1];
  Real distance2[MOST_EDGES]; // of vertex i and the next
  Real film, chosen, emission;
  Int hittable;
  Int delta[MOST_EDGES + 1]; // whether the event at the vertex is a delta event
} GivenPath;

typedef struct {
  Real of[MOST_EDGES + 1]; // of the technique with s light vertices
} TechniqueWeights;

__kernel void weigh(__global const GivenPath* paths, int edges, __global TechniqueWeights* weights) {
  const size_t item = get_global_id(0);
  const __global GivenPath* p = paths + item;
  __global Real* w = weights[item].of;
  const Mask hittable = p->hittable != 0;
  for (int s = 0; s <= MOST_EDGES; ++s) w[s] = (Real)(0.0f);
  if (edges == 1) {
    w[0] = weight_of_hit(mis_from_eye(p->film), p->chosen, p->emission);
    w[1] = weight_of_seen_light(p->film, p->chosen);
    return;
  }
  MisQuantities light[MOST_EDGES + 1], eye[MOST_EDGES + 1];
  light[1] = mis_from_light(p->chosen, p->emission, p->cosine_before[1], hittable);
  for (int i = 1; i + 1 < edges; ++i)
    light[i + 1] = mis_arrived(mis_scattered(light[i], p->forward[i], p->backward[i], p->cosine_after[i],
                                             p->delta[i] != 0, p->backward[i] / p->forward[i]),
                               p->distance2[i], p->cosine_before[i + 1]);
  MisQuantities leaving = mis_from_eye(p->film);
  for (int i = edges - 1; i >= 1; --i) {
    eye[i] = mis_arrived(leaving, p->distance2[i], p->cosine_after[i]);
    leaving = mis_scattered(eye[i], p->backward[i], p->forward[i], p->cosine_before[i], p->delta[i] != 0,
                            p->forward[i] / p->backward[i]);
  }
  w[0] = hittable ? weight_of_hit(leaving, p->chosen, p->emission) : (Real)(0.0f);
  w[1] = weight_of_light_sample(eye[1], p->chosen, p->emission, p->backward[1], p->forward[1],
                                p->cosine_before[1], hittable);
  for (int s = 2; s < edges; ++s)
    w[s] = weight_of_connection(
        connection_side(light[s - 1], p->backward[s], p->backward[s - 1], p->distance2[s - 1],
                        p->cosine_after[s - 1]),
        connection_side(eye[s], p->forward[s - 1], p->forward[s], p->distance2[s - 1], p->cosine_before[s]));
  // A technique that ends a subpath at a delta event cannot make the path.
  for (int s = 1; s < edges; ++s) w[s] = ((p->delta[s - 1] != 0) | (p->delta[s] != 0)) ? (Real)(0.0f) : w[s];
  const int last = edges - 1;
  w[edges] = weight_of_seen_vertex(light[last], p->film, p->backward[last], p->distance2[last],
                                   p->cosine_after[last]);
  w[edges] = p->delta[last] != 0 ? (Real)(0.0f) : w[edges];
}
