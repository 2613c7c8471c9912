// Path tracing traces the camera rays of the next LANES samples of a pixel together, as a packet, before they are
// needed. A path takes its hit when it starts.
#ifndef PHLUX_CAMERA_PACKETS_CL
#define PHLUX_CAMERA_PACKETS_CL

#include "scene/camera.cl"
#include "scene/traverse_packet.cl"
#include "transport/film.cl"

// A packet has one origin (no lens, no parallel rays), and its first hits are final (no masks).
#define HAS_CAMERA_PACKETS (HAS_BVH & (LANES > 1) & !HAS_MASKS & !HAS_LENS & !HAS_ORTHOGRAPHIC)
// Blocks of fewer samples take less time ray by ray.
#define LEAST_PACKET 4

// Hits of the camera rays of the job of each lane: that of its sample s is record lane * LANES + s % LANES.
typedef struct {
  Scalar distance[LANES * LANES], primitive[LANES * LANES];
} CameraHits;

// Bounds of the camera rays of the lanes of m, which are those of `pixel` and `sample`.
static inline void bound_camera_rays(const Scene* scene, Uint pixel, CameraSample sample, Mask m,
                                     PacketBounds* packet) {
  const __global CameraRecord* camera = scene->camera;
  const ImagePoint point = image_point(scene, pixel, sample);
  const Real none = (Real)(INFINITY);
  const Scalar right = min_of_lanes(m ? point.leftwards : none), left = max_of_lanes(m ? point.leftwards : -none);
  const Scalar bottom = min_of_lanes(m ? point.upwards : none), top = max_of_lanes(m ? point.upwards : -none);
  const Scalar leftwards = 0.5f * (left + right), upwards = 0.5f * (top + bottom);
  const Scalar left_size = fabs(camera->left[0]) + fabs(camera->left[1]) + fabs(camera->left[2]);
  const Scalar up_size = fabs(camera->up[0]) + fabs(camera->up[1]) + fabs(camera->up[2]);
  for (int axis = 0; axis < 3; ++axis) {
    packet->origin[axis] = camera->position[axis];
    packet->direction[axis] = camera->forward[axis] + leftwards * camera->left[axis] + upwards * camera->up[axis];
    packet->across[axis] = 0.5f * (left - right) * camera->left[axis];
    packet->down[axis] = 0.5f * (top - bottom) * camera->up[axis];
  }
  packet->terms = 1.0f + (1.0f + fabs(leftwards)) * left_size + (1.0f + fabs(upwards)) * up_size;
}

// Traces the camera rays of the next samples of the jobs of m.
static inline void trace_camera_packets(const Scene* scene, RandomSequence sequence, JobList list, Job job,
                                        CameraHits* hits, Mask m) {
  int pixels[LANES], samples[LANES], samples_left[LANES];
  int_lanes_to_array(job.pixel, pixels);
  int_lanes_to_array(sample_number(list, job), samples);
  int_lanes_to_array(list.block_samples - job.samples, samples_left);
  for (Mask waiting = m; any_lane(waiting);) {
    const int lane = first_lane(waiting);
    waiting &= LANE_NUMBERS != lane;
    const Mask traced = LANE_NUMBERS < samples_left[lane];
    sequence.pixel = (Uint)((uint)pixels[lane]);
    sequence.sample = int_to_uint(samples[lane] + LANE_NUMBERS);
    const CameraSample sample = camera_sample(scene, random_words(sequence, (Uint)(0), 0));
    PacketBounds packet;
    bound_camera_rays(scene, sequence.pixel, sample, traced, &packet);
    const Hit hit = packet_intersect(scene, camera_ray(scene, sequence.pixel, sample), &packet, traced);
    lanes_to_array(hit.distance, hits->distance + lane * LANES);
    lanes_to_array(carry_int(hit.primitive), hits->primitive + lane * LANES);
  }
}

// The hits of the camera rays of `starting`; the other lanes keep `hit`.
static inline Hit camera_hits(const Scene* scene, RandomSequence sequence, JobList list, Job job, CameraHits* hits,
                              Hit hit, Mask starting) {
  const Int number = job.samples & (LANES - 1);
  const Mask untraced = starting & (number == 0);
  if (any_lane(untraced)) trace_camera_packets(scene, sequence, list, job, hits, untraced);
  const Int record = LANE_NUMBERS * LANES + number;
  hit.distance = starting ? array_reals(hits->distance, record) : hit.distance;
  hit.primitive = starting ? carried_int(array_reals(hits->primitive, record)) : hit.primitive;
  return hit;
}

#endif
