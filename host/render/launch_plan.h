// Numbers of jobs and work-items of a launch, and sizes of its buffers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/device.h"
#include "render/parts.h"
#include "render/schedule.h"

namespace phlux::render {

/// Words of a splat record.
[[nodiscard]] std::size_t record_words(const Parts& parts);

struct LaunchPlan {
  std::size_t items = 0;      ///< work-items, a multiple of local_size
  std::size_t local_size = 1; ///< work-items of a group
  std::size_t batches = 0;    ///< 0 for path tracing, as are the members below
  std::size_t batch_paths = 0;
  std::size_t scratch_bytes = 0; ///< of all work-items, for the vertices of bidirectional path tracing
  int batch_jobs = 0;
  int rows = 0;            ///< vertices per lane
  int record_capacity = 0; ///< records per batch
};

/// What determines the number of jobs of a device's next launch.
struct Pace {
  std::int64_t lanes = 1;       ///< WIDTH
  std::int64_t first_items = 1; ///< work-items of the first launch
  std::int64_t most_jobs = 1;
  double paths = 0.0;         ///< that last as long as a launch should; 0: not known yet
  double most_paths = 0.0;    ///< whose splats fit a buffer
  bool whole_batches = false; ///< batches must not depend on how the work is split into launches

  /// When `left` jobs are left.
  [[nodiscard]] std::int64_t wanted_jobs(std::int64_t left, int block_samples) const;
};

/// Plans launches from the measurements of earlier ones.
class Planner {
public:
  /// Launches should last about `launch_seconds`.
  Planner(const device::DeviceInfo& device, const Parts& parts, double launch_seconds);

  void set_launch_seconds(double launch_seconds) { launch_seconds_ = launch_seconds; }

  [[nodiscard]] Pace pace() const;
  [[nodiscard]] LaunchPlan plan(const Launch& launch) const;

  /// Whether a batch had more vertices (a count below 0) or splats than fit; later plans have larger buffers.
  [[nodiscard]] bool overflowed(const LaunchPlan& plan, const std::vector<cl_int>& record_counts);
  /// Halves the work-items and jobs of later launches, after one of `jobs` jobs for which there was no
  /// memory. False if they are as small as they can be.
  [[nodiscard]] bool shrink(std::int64_t jobs);
  /// Records the time of a finished launch.
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
  std::int64_t most_jobs_;        // of a launch
  double paths_per_second_ = 0.0; // measured; 0: not yet
  double records_per_path_ = 2.0; // capacity
  double rows_per_path_ = 6.0;    // capacity for vertices, per path of a lane
};

} // namespace phlux::render
