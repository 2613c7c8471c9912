// How the samples of an image are cut into jobs (one pixel, one block of its samples) and jobs into launches.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

namespace phlux::render {

/// Samples of one pixel that a device sums in float before the film adds them in double: few enough that the
/// sums keep their digits, enough that handing them over costs nothing. The image depends on it, so it is the
/// same for every device, launch length and number of threads.
inline constexpr int samples_per_block = 16;

/// One launch: jobs [first_job, first_job + jobs). Job j is block j / pixels, pixel j % pixels; block b holds
/// samples first_sample + b * block_samples onwards. first_job < pixels.
struct Launch {
  std::int64_t first_job = 0;
  std::int64_t jobs = 0;
  std::int64_t first_sample = 0;
  int block_samples = samples_per_block;
};

/// How much of the work is done: every pixel has the samples below `sample`, and pixels below `pixel` have
/// the `block_samples` from there on as well, but for launches that are missing.
struct SchedulePosition {
  std::int64_t sample = 0, pixel = 0;
  int block_samples = samples_per_block;
  std::vector<Launch> missing; ///< were handed out, and their results did not come

  /// One past the last sample that any pixel has.
  [[nodiscard]] std::int64_t end() const { return pixel > 0 ? sample + block_samples : sample; }
};

/// Hands out the work. With `samples` given, every pixel gets just that many, in blocks of samples_per_block
/// and then one of what is left. Without, it never ends, and the first blocks are short (1, 1, 2, 4, 8
/// samples), so that a render that is stopped early has seen every pixel.
class Schedule {
public:
  /// Continues `from` a position, whose end() is no more than `samples`: with what is missing first, then
  /// where a schedule that had not stopped would. A number of samples that is no multiple of
  /// samples_per_block is filled up to one first.
  Schedule(std::int64_t pixels, std::optional<std::int64_t> samples, const SchedulePosition& from = {});
  /// The next launch; nothing when the work is done. `wanted` says how many jobs (>= 1) a launch should have,
  /// given how many like it are left and the samples of each.
  using Wanted = std::function<std::int64_t(std::int64_t left, int block_samples)>;
  [[nodiscard]] std::optional<Launch> next(const Wanted& wanted);
  /// The work that was handed out; missing is what is still to be handed out again.
  [[nodiscard]] SchedulePosition position() const;

private:
  // The rest of a phase: blocks of one length, as one launch would have them.
  void start_phase(std::int64_t first_sample);
  void start_blocks(std::int64_t first_sample, std::int64_t end_sample, int block_samples);
  [[nodiscard]] Launch cut_from(Launch& rest, const Wanted& wanted) const;

  std::int64_t pixels_, end_;
  bool short_blocks_first_;
  std::deque<Launch> missing_;
  Launch phase_; // what is left of it
  std::int64_t phase_end_;
};

} // namespace phlux::render
