// What a render counts and says of itself.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/schedule.h"

namespace phlux::render {

/// Where a contribution came from that was not finite: the seed, this pixel (row by row from the top) and
/// this sample, or one of so many from it, make it again.
struct Origin {
  std::int64_t pixel = 0, sample = 0;
  int samples = 1;
};

struct Counts {
  std::uint64_t paths = 0, rays = 0, shadow_rays = 0, nonfinite = 0;
  std::optional<Origin> first_nonfinite;
};

/// How far a render has come: with its film, all that another takes to go on.
struct RenderState : Counts {
  SchedulePosition position;
  double seconds_render = 0.0;
};

struct Progress {
  double samples_done = 0.0;           ///< mean samples per pixel so far
  std::optional<double> samples_total; ///< absent when time or error ends the render
  double seconds = 0.0;                ///< since rendering began
  std::uint64_t paths = 0;
  std::function<RenderState()> state = {}; ///< of what the film has; a little slow
};

struct Statistics : RenderState {
  std::string device, driver;
  int lanes = 1;
  bool portable_lanes = false;    ///< the compiler refused the processor's own instructions
  std::string traversal;          ///< brute or bvh
  std::vector<std::string> parts; ///< what the scene's kernel holds code for
  double seconds_setup = 0.0, seconds_build_kernels = 0.0;
  bool kernels_from_cache = false;
  bool shines = true; ///< some light of the scene has power
  bool interrupted = false;
};

} // namespace phlux::render
