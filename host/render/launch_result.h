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

/// Adds results to a film. The film depends on their order, by rounding, but not on the number of threads.
class ResultFolder {
public:
  /// For an image of `pixels` pixels. Records tell their techniques if `techniques` is set. Up to `threads`
  /// threads add the results, each to other rows of the film.
  ResultFolder(std::int64_t pixels, bool techniques, std::size_t threads)
      : pixels_(static_cast<std::size_t>(pixels)), techniques_(techniques), splats_(threads) {}
  /// Changes the records. Returns what was counted. If it throws, the film is no longer valid.
  Counts fold(LaunchResult& result, film::Film& film);

private:
  // Contributions that were not finite: their number, and those of the first job that has some.
  struct NotFinite {
    std::uint64_t count = 0;
    std::size_t job = 0;
    int sample = 0, samples = 1; ///< the first of `samples` samples of the job's block

    void add(const NotFinite& others);
  };
  struct Jobs {
    std::size_t first, count;
  };
  // All jobs if there are no batches.
  [[nodiscard]] Jobs jobs_of(const LaunchResult& result, std::size_t batch) const;
  template<class Target>
  void fold_sums(const LaunchResult& result, Jobs jobs, Target& to, NotFinite& lost) const;
  template<class Target, class AddSplats>
  void fold_batch(const LaunchResult& result, std::size_t batch, Target& to, NotFinite& lost,
                  const AddSplats& add_splats) const;
  [[nodiscard]] NotFinite lost_paths(const LaunchResult& result, std::size_t batch,
                                     const std::vector<std::size_t>& paths) const;
  void fold_whole(const LaunchResult& result, film::Film& film, NotFinite& lost);
  void fold_in_parts(const LaunchResult& result, film::Film& film, NotFinite& lost);

  std::size_t pixels_;
  bool techniques_;
  std::vector<film::SplatFolder> splats_; // of each thread
  film::DividedSplats divided_;
};

} // namespace phlux::render
