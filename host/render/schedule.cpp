#include "render/schedule.h"

#include <algorithm>
#include <limits>

namespace phlux::render {
namespace {

// More samples than any render takes, few enough that their number fits the kernels' int.
constexpr std::int64_t endless = std::numeric_limits<std::int32_t>::max() / 2;

} // namespace

Schedule::Schedule(std::int64_t pixels, std::optional<std::int64_t> samples) : pixels_(pixels) {
  if (samples) {
    const std::int64_t rest = *samples % samples_per_block, whole = *samples - rest;
    if (rest > 0) later_ = {{whole, *samples, static_cast<int>(rest)}};
    start_phase({0, whole, samples_per_block});
    return;
  }
  later_ = {{samples_per_block, endless, samples_per_block}, {8, 16, 8}, {4, 8, 4}, {2, 4, 2}, {1, 2, 1}};
  start_phase({0, 1, 1});
}

void Schedule::start_phase(Phase phase) {
  phase_ = phase;
  const std::int64_t samples = phase.end_sample - phase.first_sample;
  jobs_ = pixels_ * (samples / phase.block_samples);
  done_ = 0;
}

std::optional<Launch> Schedule::next(const Wanted& wanted) {
  if (done_ == jobs_) {
    if (later_.empty()) return std::nullopt;
    start_phase(later_.back());
    later_.pop_back();
  }
  // A launch begins at its first job's block, so that the kernel counts in small numbers.
  const std::int64_t block = done_ / pixels_;
  Launch launch;
  launch.first_job = done_ - block * pixels_;
  launch.jobs = std::min(wanted(jobs_ - done_, phase_.block_samples), jobs_ - done_);
  launch.block_samples = phase_.block_samples;
  launch.first_sample = phase_.first_sample + block * phase_.block_samples;
  done_ += launch.jobs;
  return launch;
}

} // namespace phlux::render
