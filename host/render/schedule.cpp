#include "render/schedule.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace phlux::render {
namespace {

// log2 of the number of point sets in an octave of samples.
constexpr int octave_bits = 3;

} // namespace

int point_bits(std::int64_t sample) {
  const int octave = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(sample))) - 1;
  return std::clamp(octave - octave_bits, 0, most_point_bits);
}

Schedule::Schedule(std::int64_t pixels, std::optional<std::int64_t> samples, const SchedulePosition& from,
                   Blocks blocks, std::int64_t most)
    : pixels_(pixels), end_(samples.value_or(most)), blocks_(blocks),
      short_blocks_first_(!samples && blocks == Blocks::of_independent),
      missing_(from.missing.begin(), from.missing.end()), phase_end_(from.sample) {
  assert(from.end() <= end_ && from.pixel < pixels);
  if (from.pixel == 0) return;
  const Whole whole = whole_blocks(from.sample);
  start_blocks(from.sample, from.block_samples == whole.length ? whole.end : from.end(), from.block_samples);
  phase_.first_job = from.pixel;
  phase_.jobs -= from.pixel;
}

Schedule::Whole Schedule::whole_blocks(std::int64_t first_sample) const {
  if (blocks_ == Blocks::of_independent) return {samples_per_block, end_};
  const int bits = point_bits(first_sample);
  const std::int64_t octave_end = std::int64_t{2} << (bits + octave_bits);
  return {std::int64_t{1} << bits, bits == most_point_bits ? end_ : std::min(end_, octave_end)};
}

void Schedule::start_blocks(std::int64_t first_sample, std::int64_t end_sample, int block_samples) {
  const std::int64_t blocks = (end_sample - first_sample) / block_samples;
  phase_ = {0, pixels_ * blocks, first_sample, block_samples};
  phase_end_ = first_sample + blocks * block_samples;
}

void Schedule::start_phase(std::int64_t first_sample) {
  const Whole whole = whole_blocks(first_sample);
  const std::int64_t left = end_ - first_sample;
  std::int64_t block = whole.length - first_sample % whole.length;
  if (short_blocks_first_ && first_sample < samples_per_block &&
      (first_sample == 0 || std::has_single_bit(static_cast<std::uint64_t>(first_sample))))
    block = std::max<std::int64_t>(first_sample, 1);
  block = std::min(block, left);
  start_blocks(first_sample, block == whole.length ? whole.end : first_sample + block,
               static_cast<int>(block));
}

// Removes the first jobs of `rest` and returns them.
Launch Schedule::cut_from(Launch& rest, const Wanted& wanted) const {
  Launch launch = rest;
  launch.jobs = std::min(wanted(rest.jobs, rest.block_samples), rest.jobs);
  // A launch begins at its first job's block, so that its job numbers are small.
  const std::int64_t job = rest.first_job + launch.jobs;
  rest.first_job = job % pixels_;
  rest.first_sample += job / pixels_ * rest.block_samples;
  rest.jobs -= launch.jobs;
  return launch;
}

std::optional<Launch> Schedule::next(const Wanted& wanted) {
  if (!missing_.empty()) {
    const Launch launch = cut_from(missing_.front(), wanted);
    if (missing_.front().jobs == 0) missing_.pop_front();
    return launch;
  }
  if (phase_.jobs == 0) {
    if (phase_end_ == end_) return std::nullopt;
    start_phase(phase_end_);
  }
  return cut_from(phase_, wanted);
}

void Schedule::give_back(const std::deque<Launch>& launches) {
  missing_.insert(missing_.begin(), launches.begin(), launches.end());
}

SchedulePosition Schedule::position() const {
  SchedulePosition position{phase_end_, 0, samples_per_block, {missing_.begin(), missing_.end()}};
  if (phase_.jobs > 0) {
    position.sample = phase_.first_sample;
    position.pixel = phase_.first_job;
    position.block_samples = phase_.block_samples;
  }
  return position;
}

} // namespace phlux::render
