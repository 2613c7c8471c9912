// The results of a launch, and their addition to the film.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "film/film.h"
#include "film/splat_records.h"
#include "render/schedule.h"
#include "render/statistics.h"

namespace phlux::render {

/// The sums and splats of a launch. Moved, never copied, as `batches` points into `memory`.
struct LaunchResult {
  Launch launch;                           ///< first_sample counts from sample 0 of the seed
  std::vector<film::BlockSum> sums;        ///< per job; none for light tracing
  std::size_t batch_jobs = 0;              ///< jobs of each batch but the last
  std::size_t record_words = 0;            ///< words of a record of a splat
  std::vector<film::SplatRecords> batches; ///< none for path tracing
  bool merged = false;                     ///< SplatFolder::merge() was applied to the batches
  std::shared_ptr<void> memory;            ///< of the batches; none while these are in a device's memory
  std::uint64_t rays = 0, shadow_rays = 0;

  LaunchResult() = default;
  LaunchResult(LaunchResult&&) = default;
  LaunchResult& operator=(LaunchResult&&) = default;
};

/// Copies the batches into the result's own memory, without their unused parts. @throws std::bad_alloc
void own_batches(LaunchResult& result);

/// Adds results to a film. The film depends on their order, by rounding.
class ResultFolder {
public:
  /// For an image of `pixels` pixels. Records tell their techniques if `techniques` is set.
  ResultFolder(std::int64_t pixels, bool techniques) : pixels_(pixels), techniques_(techniques) {}
  /// Changes the records. Returns what was counted. If it throws, the film is no longer valid.
  Counts fold(LaunchResult& result, film::Film& film);

private:
  void fold_sums(const LaunchResult& result, std::size_t first_job, std::size_t jobs, film::Film& film);
  void fold_batch(LaunchResult& result, std::size_t batch, film::Film& film);
  void count_nonfinite(const Launch& launch, std::size_t job, std::uint64_t count, int sample, int samples);

  std::int64_t pixels_;
  bool techniques_;
  film::SplatFolder splats_;
  Counts counts_; // of the result at hand
};

} // namespace phlux::render
