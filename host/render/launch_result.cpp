#include "render/launch_result.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace phlux::render {

void own_batches(LaunchResult& result) {
  std::size_t records = 0;
  for (const film::SplatRecords& batch : result.batches) records += batch.count;
  auto words = std::make_shared_for_overwrite<float[]>(records * result.record_words);
  float* to = words.get();
  for (film::SplatRecords& batch : result.batches) {
    float* const begin = to;
    for (std::size_t array = 0; array < result.record_words; ++array)
      to = std::copy_n(batch.words + array * batch.capacity, batch.count, to);
    batch.words = begin;
    batch.capacity = batch.count;
  }
  result.memory = std::move(words);
}

// Counts contributions that were not finite, among the given samples of a job's block.
void ResultFolder::count_nonfinite(const Launch& launch, std::size_t job, std::uint64_t count, int sample,
                                   int samples) {
  counts_.nonfinite += count;
  if (counts_.first_nonfinite) return;
  const std::int64_t place = launch.first_job + static_cast<std::int64_t>(job);
  counts_.first_nonfinite = {place % pixels_,
                             launch.first_sample + place / pixels_ * launch.block_samples + sample, samples};
}

void ResultFolder::fold_sums(const LaunchResult& result, std::size_t first_job, std::size_t jobs,
                             film::Film& film) {
  const Launch& launch = result.launch;
  std::int64_t pixel = (launch.first_job + static_cast<std::int64_t>(first_job)) % pixels_;
  for (std::size_t job = first_job; job < first_job + jobs; ++job) {
    const film::BlockSum& sum = result.sums[job];
    film.add(static_cast<std::size_t>(pixel), sum, static_cast<std::uint32_t>(launch.block_samples));
    if (++pixel == pixels_) pixel = 0;
    if (sum.nonfinite > 0)
      count_nonfinite(launch, job, static_cast<std::uint64_t>(sum.nonfinite), 0, launch.block_samples);
  }
}

void ResultFolder::fold_batch(LaunchResult& result, std::size_t batch, film::Film& film) {
  const auto samples = static_cast<std::size_t>(result.launch.block_samples);
  const std::size_t first_job = batch * result.batch_jobs;
  const std::size_t jobs =
      std::min(result.batch_jobs, static_cast<std::size_t>(result.launch.jobs) - first_job);
  if (!result.sums.empty()) fold_sums(result, first_job, jobs, film);

  const film::SplatRecords& records = result.batches[batch];
  film.add_splatting_paths(jobs * samples);
  if (techniques_) film::SplatFolder::fold_techniques(records, film);
  if (!result.merged) splats_.merge(records);
  for (const std::size_t path : film::SplatFolder::fold(records, film))
    count_nonfinite(result.launch, first_job + path / samples, 1, static_cast<int>(path % samples), 1);
}

Counts ResultFolder::fold(LaunchResult& result, film::Film& film) {
  counts_ = {};
  if (!result.batches.empty()) film.use_splats();
  for (std::size_t batch = 0; batch < result.batches.size(); ++batch) fold_batch(result, batch, film);
  if (result.batches.empty()) fold_sums(result, 0, result.sums.size(), film);
  counts_.paths = static_cast<std::uint64_t>(result.launch.jobs) *
                  static_cast<std::uint64_t>(result.launch.block_samples);
  counts_.rays = result.rays;
  counts_.shadow_rays = result.shadow_rays;
  return counts_;
}

} // namespace phlux::render
