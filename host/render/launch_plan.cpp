#include "render/launch_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "device/work_groups.h"
#include "scene/scene_data.h"

namespace phlux::render {
namespace {

// A lane without further paths idles until its work-item (or batch) ends; with this many paths per lane, that
// is a few percent of the time. On a GPU, with one lane per work-item, fewer paths keep the batches' vertices
// small.
constexpr int least_paths_wide = 64, least_paths_scalar = 16;

// Work-items of a launch: on CPUs a few per core, for load balance; elsewhere several times as many as a
// compute unit can run at once.
std::size_t work_items(const device::DeviceInfo& info) {
  return static_cast<std::size_t>(info.compute_units) * (info.type == "cpu" ? 4 : 4096);
}

// The smallest number of jobs of a lane.
int least_lane_jobs(int lanes, int block_samples) {
  const int paths = lanes == 1 ? least_paths_scalar : least_paths_wide;
  return (paths + block_samples - 1) / block_samples;
}

int vertex_words(const Parts& parts) {
  return VERTEX_WORDS_PLAIN + (parts.smooth_normals ? VERTEX_WORDS_OF_NORMAL : 0) +
         (parts.has_tangents() ? VERTEX_WORDS_OF_TANGENT : 0) +
         (parts.has_textures() ? VERTEX_WORDS_OF_UV : 0);
}

// Size of Scalar (kernels/lanes/lanes.h), the type of vertices in scratch memory.
std::size_t scalar_bytes(const Parts& parts) {
  return parts.double_precision ? sizeof(cl_double) : sizeof(cl_float);
}

} // namespace

std::size_t record_words(const Parts& parts) {
  return parts.techniques ? RECORD_TECHNIQUE + 1 : RECORD_VALUE + 3;
}

Planner::Planner(const device::DeviceInfo& device, const Parts& parts, double launch_seconds)
    : device_(device), parts_(parts), launch_seconds_(launch_seconds),
      local_size_(device::group_size(parts.lanes)), units_(device.compute_units),
      first_items_(std::max(work_items(device) / 64, units_)), items_(work_items(device)),
      most_jobs_(std::numeric_limits<cl_int>::max() / 8) {} // the kernel counts the words of sums in int

int Planner::batch_jobs(int block_samples) const {
  return parts_.lanes * least_lane_jobs(parts_.lanes, block_samples);
}

Pace Planner::pace() const {
  const double bytes_per_path =
      (records_per_path_ + 1) * static_cast<double>(record_words(parts_) * sizeof(float));
  return {.lanes = parts_.lanes,
          .first_items = static_cast<std::int64_t>(first_items_),
          .most_jobs = most_jobs_,
          .paths = paths_per_second_ * launch_seconds_,
          .most_paths = static_cast<double>(device_.largest_buffer) / (4 * bytes_per_path),
          .whole_batches = settings::info_of(parts_.integrator).light_paths};
}

std::int64_t Pace::wanted_jobs(std::int64_t left, int block_samples) const {
  const std::int64_t least = lanes * least_lane_jobs(static_cast<int>(lanes), block_samples);
  // The first launch, of unknown speed, has one batch per work-item.
  std::int64_t jobs = first_items * least;
  if (paths > 0) jobs = static_cast<std::int64_t>(paths / block_samples);
  std::int64_t largest = most_jobs;
  if (whole_batches) largest = std::min(largest, static_cast<std::int64_t>(most_paths / block_samples));
  jobs = std::clamp(jobs, lanes, std::max(lanes, std::min(left, largest)));
  return whole_batches ? (jobs + least - 1) / least * least : jobs;
}

// See divide_scratch in kernels/transport/bidir.cl.
std::size_t Planner::scratch_bytes_per_item(const LaunchPlan& plan) const {
  const auto vertices = static_cast<std::size_t>(plan.rows) * static_cast<std::size_t>(parts_.lanes);
  return (2 * vertices * static_cast<std::size_t>(vertex_words(parts_)) +
          SCRATCH_WORDS_PER_PATH * plan.batch_paths) *
         scalar_bytes(parts_);
}

LaunchPlan Planner::plan(const Launch& launch) const {
  LaunchPlan plan;
  plan.local_size = local_size_;
  const auto round_up = [&](std::size_t items) {
    return (items + local_size_ - 1) / local_size_ * local_size_;
  };
  const auto jobs = static_cast<std::size_t>(launch.jobs), lanes = static_cast<std::size_t>(parts_.lanes);
  const auto per_batch = static_cast<std::size_t>(batch_jobs(launch.block_samples));
  const settings::IntegratorInfo& integrator = settings::info_of(parts_.integrator);
  if (!integrator.light_paths) {
    // Each lane has its smallest number of paths or more, unless compute units would be idle.
    const std::size_t full = jobs / per_batch, most = (jobs + lanes - 1) / lanes;
    plan.items = round_up(std::clamp(std::max(full, std::min(most, units_)), std::size_t{1}, items_));
    return plan;
  }
  plan.batch_jobs = static_cast<int>(per_batch);
  plan.batch_paths = per_batch * static_cast<std::size_t>(launch.block_samples);
  plan.batches = (jobs + per_batch - 1) / per_batch;
  plan.items = std::clamp(plan.batches, std::size_t{1}, items_);
  const double lane_paths = static_cast<double>(plan.batch_paths) / parts_.lanes;
  plan.rows = static_cast<int>(std::ceil(rows_per_path_ * lane_paths));
  plan.record_capacity =
      static_cast<int>(std::ceil(records_per_path_ * lane_paths)) * parts_.lanes + parts_.lanes;
  if (integrator.bidirectional()) {
    // Two launches are in flight, and other tables need memory.
    const std::size_t room = std::min(device_.largest_buffer / 2, device_.global_memory / 8);
    const std::size_t fit = room / scratch_bytes_per_item(plan);
    plan.items =
        std::clamp(plan.items, std::size_t{1}, std::max(fit / local_size_ * local_size_, local_size_));
  }
  plan.items = round_up(plan.items);
  if (integrator.bidirectional()) plan.scratch_bytes = plan.items * scratch_bytes_per_item(plan);
  return plan;
}

bool Planner::overflowed(const LaunchPlan& plan, const std::vector<cl_int>& record_counts) {
  if (plan.batches == 0) return false;
  const int most = std::ranges::max(record_counts);
  const bool splats = most > plan.record_capacity - parts_.lanes;
  const bool vertices = std::ranges::min(record_counts) < 0;
  const auto paths = static_cast<double>(plan.batch_paths);
  if (splats) records_per_path_ = std::max(records_per_path_, 1.25 * most / paths);
  if (vertices) rows_per_path_ = std::max(rows_per_path_, 2 * plan.rows / (paths / parts_.lanes));
  return splats || vertices;
}

bool Planner::shrink(std::int64_t jobs) {
  const bool batches = settings::info_of(parts_.integrator).light_paths;
  const std::int64_t least = batches ? batch_jobs(samples_per_block) : parts_.lanes;
  const std::int64_t before = std::min(jobs, most_jobs_), fewer_jobs = std::max(before / 2, least);
  const std::size_t fewer_items = std::max(items_ / 2 / local_size_ * local_size_, local_size_);
  const bool smaller = fewer_jobs < before || fewer_items < items_;
  most_jobs_ = fewer_jobs;
  items_ = fewer_items;
  return smaller;
}

void Planner::note_time(std::int64_t paths, double seconds) {
  if (seconds <= 0) return;
  const double rate = static_cast<double>(paths) / seconds;
  // At most 4 times the last rate: the first launch may not be representative.
  paths_per_second_ = paths_per_second_ > 0 ? std::min(rate, 4 * paths_per_second_) : rate;
}

} // namespace phlux::render
