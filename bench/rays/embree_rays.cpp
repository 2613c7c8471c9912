#include "bench/rays/embree_rays.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <thread>

namespace phlux::bench {
namespace {

RTCRay ray_of(const Ray& ray, float distance) {
  RTCRay r{};
  r.org_x = ray.origin[0], r.org_y = ray.origin[1], r.org_z = ray.origin[2];
  r.dir_x = ray.direction[0], r.dir_y = ray.direction[1], r.dir_z = ray.direction[2];
  r.tfar = distance;
  r.mask = 0xFFFFFFFF;
  return r;
}

#if RTC_VERSION_MAJOR >= 4
void intersect(RTCScene scene, RTCRayHit& query) {
  rtcIntersect1(scene, &query);
}
void occluded(RTCScene scene, RTCRay& query) {
  rtcOccluded1(scene, &query);
}
#else
void intersect(RTCScene scene, RTCRayHit& query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
}
void occluded(RTCScene scene, RTCRay& query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &query);
}
#endif

} // namespace

EmbreeRays::EmbreeRays(const scene::Mesh& mesh, const scene::Vec3& origin, unsigned threads)
    : threads_(threads), device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_.get())) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
  for (const scene::Vec3& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) *positions++ = static_cast<float>(p[axis] - origin[axis]);
  auto* corners = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                              mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) corners = std::copy(triangle.begin(), triangle.end(), corners);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
}

void EmbreeRays::closest(const std::vector<Ray>& rays, std::vector<float>& found) const {
  in_threads(rays.size(), [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      RTCRayHit query{};
      query.ray = ray_of(rays[i], std::numeric_limits<float>::infinity());
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      intersect(scene_.get(), query);
      found[i] = query.ray.tfar;
    }
  });
}

void EmbreeRays::any(const std::vector<Ray>& rays, std::vector<float>& found) const {
  in_threads(rays.size(), [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      RTCRay query = ray_of(rays[i], rays[i].distance);
      occluded(scene_.get(), query);
      found[i] = query.tfar < 0 ? 1.0f : 0.0f;
    }
  });
}

void EmbreeRays::in_threads(std::size_t count,
                            const std::function<void(std::size_t, std::size_t)>& work) const {
  std::vector<std::jthread> threads;
  for (unsigned t = 0; t < threads_; ++t)
    threads.emplace_back([=, this] { work(count * t / threads_, count * (t + 1) / threads_); });
}

} // namespace phlux::bench
