// How a launch is laid out on a device: how many jobs and work-items it has, and what room they have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/device.h"
#include "render/parts.h"
#include "render/schedule.h"

namespace phlux::render {

/// Floats of a record of a batch's contributions.
[[nodiscard]] std::size_t record_words(const Parts& parts);

struct LaunchPlan {
  std::size_t items = 0;      ///< work-items, a multiple of local_size
  std::size_t local_size = 1; ///< work-items of a group
  std::size_t batches = 0;    ///< 0 for path tracing, which has none; the rest is 0 then
  std::size_t batch_paths = 0;
  std::size_t scratch_bytes = 0; ///< of all work-items: bidirectional path tracing's vertices
  int batch_jobs = 0;
  int rows = 0;            ///< of a lane: steps of subpaths
  int record_capacity = 0; ///< of a batch
};

/// Learns from one launch what the next ones need.
class Planner {
public:
  /// Launches should last about `launch_seconds`.
  Planner(const device::DeviceInfo& device, const Parts& parts, double launch_seconds);

  /// Jobs that the next launch should have, given how many are left.
  [[nodiscard]] std::int64_t wanted_jobs(std::int64_t left, int block_samples) const;
  [[nodiscard]] LaunchPlan plan(const Launch& launch) const;

  /// Whether some batch had more vertices (a count below 0) or splats than there was room for; plans more
  /// room from then on.
  [[nodiscard]] bool overflowed(const LaunchPlan& plan, const std::vector<cl_int>& record_counts);
  /// Of a launch that has ended.
  void note_time(std::int64_t paths, double seconds);

private:
  [[nodiscard]] int batch_jobs(int block_samples) const;
  [[nodiscard]] std::size_t scratch_bytes_per_item(const LaunchPlan& plan) const;

  device::DeviceInfo device_;
  Parts parts_;
  double launch_seconds_;
  std::size_t local_size_;
  std::size_t units_;             // compute units
  std::size_t first_items_;       // work-items of the first launch
  std::size_t items_;             // work-items of a full launch
  double paths_per_second_ = 0.0; // as measured; 0: not yet
  double records_per_path_ = 2.0; // that there is room for
  double rows_per_path_ = 6.0;    // of a lane: steps of a subpath that there is room for
};

} // namespace phlux::render
