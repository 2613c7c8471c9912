// How the samples of an image are cut into jobs (one pixel, one block of its samples) and jobs into launches.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace phlux::render {

/// Samples of one pixel that a device sums in float before the film adds them in double: few enough that the
/// sums keep their digits, enough that handing them over costs nothing. The image depends on it, so it is the
/// same for every device, launch length and number of threads.
inline constexpr int samples_per_block = 16;

/// One launch: jobs [first_job, first_job + jobs) of a phase. Job j is block j / pixels, pixel j % pixels;
/// block b holds samples first_sample + b * block_samples onwards.
struct Launch {
  std::int64_t first_job = 0;
  std::int64_t jobs = 0;
  std::int64_t first_sample = 0;
  int block_samples = samples_per_block;
};

/// Hands out the work. With `samples` given, every pixel gets just that many, in blocks of samples_per_block
/// and then one of what is left. Without, it never ends, and the first blocks are short (1, 1, 2, 4, 8
/// samples), so that a render that is stopped early has seen every pixel.
class Schedule {
public:
  Schedule(std::int64_t pixels, std::optional<std::int64_t> samples);
  /// The next launch; nothing when the work is done. `wanted` says how many jobs (>= 1) a launch should have,
  /// given how many like it are left and the samples of each.
  using Wanted = std::function<std::int64_t(std::int64_t left, int block_samples)>;
  [[nodiscard]] std::optional<Launch> next(const Wanted& wanted);

private:
  struct Phase {
    std::int64_t first_sample, end_sample;
    int block_samples;
  };
  void start_phase(Phase phase);

  std::int64_t pixels_;
  std::vector<Phase> later_; // last one first
  Phase phase_{};
  std::int64_t jobs_ = 0, done_ = 0;
};

} // namespace phlux::render
