// Ray traversal by Embree, for comparison.
#pragma once

#include <functional>
#include <memory>
#include <type_traits>
#include <vector>

#include "accel/embree.h"
#include "scene/scene.h"

namespace phlux::bench {

/// The layout that kernels/measure/rays.cl reads.
struct Ray {
  float origin[3], direction[3], distance, unused = 0;
};

class EmbreeRays {
public:
  /// Builds Embree's hierarchy over the mesh, in coordinates relative to `origin`.
  EmbreeRays(const scene::Mesh& mesh, const scene::Vec3& origin, unsigned threads);

  /// Sets found[i] to the distance of the closest intersection of ray i, infinite if there is none
  /// (rtcIntersect1).
  void closest(const std::vector<Ray>& rays, std::vector<float>& found) const;
  /// Sets found[i] to 1 if ray i has an intersection before its distance, else to 0 (rtcOccluded1).
  void any(const std::vector<Ray>& rays, std::vector<float>& found) const;

private:
  void in_threads(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) const;

  template<auto release>
  struct Releaser {
    template<typename T>
    void operator()(T* handle) const {
      release(handle);
    }
  };
  unsigned threads_;
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, Releaser<rtcReleaseDevice>> device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, Releaser<rtcReleaseScene>> scene_;
};

} // namespace phlux::bench
