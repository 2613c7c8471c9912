// One device at work on path tracing: launches of bounded length, their results folded into the film.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "device/program.h"
#include "film/film.h"
#include "render/device_scene.h"
#include "render/schedule.h"

namespace phlux::render {

struct Counts {
  std::uint64_t paths = 0, rays = 0, shadow_rays = 0, nonfinite = 0;
};

class PathLauncher {
public:
  PathLauncher(const device::Device& device, const cl::Program& program, const HostScene& scene,
               const Parts& parts, const Settings& settings);

  /// Launches nothing, which makes the driver finish what it puts off until a kernel's first launch: PoCL
  /// compiles most of it then.
  void warm_up();

  /// Jobs that the next launch should have to last about Settings::launch_seconds, given how many are left.
  [[nodiscard]] std::int64_t wanted_jobs(std::int64_t left, int block_samples) const;
  void enqueue(const Launch& launch);
  [[nodiscard]] std::size_t in_flight() const { return flights_.size(); }
  void wait(); ///< for the oldest launch
  /// Folds the oldest launch into the film.
  void collect(film::Film& film);
  [[nodiscard]] const Counts& counts() const { return counts_; }

private:
  struct Flight {
    Launch launch;
    std::size_t items = 0, lane_jobs = 0;
    cl::Buffer sums, counters;
    cl::Event kernel_done, sums_read, counters_read;
    std::vector<film::BlockSum> host_sums;
    std::vector<cl_uint> host_counters;
  };
  Flight start(const Launch& launch);
  void read_back(Flight& flight);
  void adapt(const Flight& flight);

  device::Device device_;
  DeviceScene scene_;
  cl::Kernel kernel_;
  cl_uint first_launch_argument_;
  int lanes_;
  std::int64_t pixels_;
  double launch_seconds_;
  std::size_t units_;             // compute units
  std::size_t first_items_;       // work-items of the first launch
  std::size_t items_;             // work-items of a full launch
  double paths_per_second_ = 0.0; // as measured; 0: not yet
  std::deque<Flight> flights_;
  Counts counts_;
};

} // namespace phlux::render
