// Divides the samples of an image into jobs (one block of samples of one pixel) and jobs into launches.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "settings/settings.h"

namespace phlux::render {

/// Samples of one pixel that a device sums in float before the film adds them in double: few enough for the
/// sums' precision, enough that their transfer takes little time. The image depends on it, so that it is the
/// same for every device, launch length and number of threads.
inline constexpr int samples_per_block = 16;
/// log2 of the number of samples in the longest point set, see point_bits(), and that number: the most that
/// any block has.
inline constexpr int most_point_bits = 6, most_block_samples = 1 << most_point_bits;

/// How a pixel's samples form blocks. The length of blocks of independent samples does not matter. Samples of
/// a point set depend on each other, and different sets do not: such a set is a block, and variances are
/// estimated from the sums of blocks. Sets become longer with the number of samples, so that there are always
/// enough of them.
enum class Blocks { of_independent, of_point_sets };

/// log2 of the length of the point set of a pixel's sample (from 0): the samples [2^k, 2^(k+1)) form eight
/// sets, but sets have one sample up to sample 16, and at most 64. With 2^k samples, their number of equal
/// sets that says as much of a variance, (sum of lengths)^2 / sum of squared lengths (Kish 1965), is at least
/// 16.
[[nodiscard]] int point_bits(std::int64_t sample);

/// One launch: jobs [first_job, first_job + jobs), first_job < pixels. Job j is block j / pixels of pixel
/// j % pixels; block b is the block_samples samples from first_sample + b * block_samples on.
struct Launch {
  std::int64_t first_job = 0;
  std::int64_t jobs = 0;
  std::int64_t first_sample = 0;
  int block_samples = samples_per_block;
};

/// Whether a begins before b in the sequence of jobs; launches have no job in common.
[[nodiscard]] inline bool precedes(const Launch& a, const Launch& b) {
  return std::pair(a.first_sample, a.first_job) < std::pair(b.first_sample, b.first_job);
}

/// The work that is done: all pixels have the samples below `sample`, and pixels below `pixel` also the next
/// `block_samples`, except those of missing launches.
struct SchedulePosition {
  std::int64_t sample = 0, pixel = 0;
  int block_samples = samples_per_block;
  std::vector<Launch> missing; ///< started, but not finished

  /// One past the last sample that any pixel has.
  [[nodiscard]] std::int64_t end() const { return pixel > 0 ? sample + block_samples : sample; }
};

/// The sequence of launches. With `samples` given, every pixel gets exactly that many, in blocks of
/// samples_per_block and a last one of the rest. Otherwise it goes on to `most`, and the first blocks are
/// short (1, 1, 2, 4, 8 samples), so that a render that is stopped early has samples in every pixel. The last
/// point set of a pixel may be incomplete.
class Schedule {
public:
  /// Continues `from` a position, whose end() is at most `samples` or `most`: first its missing launches,
  /// then the launches of an uninterrupted schedule. If the number of samples is no multiple of
  /// samples_per_block, the first blocks complete it to one.
  Schedule(std::int64_t pixels, std::optional<std::int64_t> samples, const SchedulePosition& from = {},
           Blocks blocks = Blocks::of_independent, std::int64_t most = settings::most_samples);
  /// The next launch; nothing when the work is done. `wanted` returns the number of jobs (>= 1) of a launch,
  /// given the number of similar jobs left and the samples of each.
  using Wanted = std::function<std::int64_t(std::int64_t left, int block_samples)>;
  [[nodiscard]] std::optional<Launch> next(const Wanted& wanted);
  /// Takes back launches that were not finished: they come next.
  void give_back(const std::deque<Launch>& launches);
  [[nodiscard]] const std::deque<Launch>& missing() const { return missing_; }
  /// Whether there is a next launch.
  [[nodiscard]] bool has_more() const { return !missing_.empty() || phase_.jobs > 0 || phase_end_ < end_; }
  /// The launches so far; `missing` are those still to be repeated.
  [[nodiscard]] SchedulePosition position() const;

private:
  // A phase has blocks of one length.
  void start_phase(std::int64_t first_sample);
  void start_blocks(std::int64_t first_sample, std::int64_t end_sample, int block_samples);
  [[nodiscard]] Launch cut_from(Launch& rest, const Wanted& wanted) const;

  // The length of whole blocks from a sample on, and the sample up to which they have it.
  struct Whole {
    std::int64_t length, end;
  };
  [[nodiscard]] Whole whole_blocks(std::int64_t first_sample) const;

  std::int64_t pixels_, end_;
  Blocks blocks_;
  bool short_blocks_first_;
  std::deque<Launch> missing_;
  Launch phase_; // the rest of it
  std::int64_t phase_end_;
};

} // namespace phlux::render
