// The state, progress and statistics of a render.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/schedule.h"

namespace phlux::render {

/// The origin of a contribution that was not finite: pixel (row by row from the top) and first of `samples`
/// samples, one of which reproduces it with the same seed.
struct Origin {
  std::int64_t pixel = 0, sample = 0;
  int samples = 1;
};

struct Counts {
  std::uint64_t paths = 0, rays = 0, shadow_rays = 0, nonfinite = 0;
  std::optional<Origin> first_nonfinite;
};

/// The state from which, with its film, a render resumes.
struct RenderState : Counts {
  SchedulePosition position;
  double seconds_render = 0.0;
};

struct Progress {
  double samples_done = 0.0;           ///< mean samples per pixel so far
  std::optional<double> samples_total; ///< absent when a time limit or target error ends the render
  double seconds = 0.0;                ///< since rendering began
  std::uint64_t paths = 0;
  std::function<RenderState()> state = {}; ///< the state that belongs to the film; somewhat slow
};

struct Statistics : RenderState {
  std::string device, driver;
  int lanes = 1;
  bool portable_lanes = false;    ///< see device::portable_lanes
  std::string traversal;          ///< brute or bvh
  std::vector<std::string> parts; ///< Parts::names()
  double seconds_setup = 0.0, seconds_build_kernels = 0.0;
  bool kernels_from_cache = false; ///< of every device
  bool shines = true;              ///< whether a light of the scene has power
  bool interrupted = false;
};

} // namespace phlux::render
