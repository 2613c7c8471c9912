#include "render/launch_result.h"

#include <algorithm>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

#include "in_parallel.h"

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

void ResultFolder::NotFinite::add(const NotFinite& others) {
  if (others.count == 0) return;
  if (count == 0 || std::tuple(others.job, others.sample, others.samples) < std::tuple(job, sample, samples))
    std::tie(job, sample, samples) = std::tie(others.job, others.sample, others.samples);
  count += others.count;
}

// Adds the sums of those jobs whose rows of tiles `to` has.
template<class Target>
void ResultFolder::fold_sums(const LaunchResult& result, Jobs jobs, Target& to, NotFinite& lost) const {
  const int samples = result.launch.block_samples;
  const std::size_t end = jobs.first + jobs.count;
  for (std::size_t job = jobs.first; job < end;) {
    std::size_t pixel = (static_cast<std::size_t>(result.launch.first_job) + job) % pixels_;
    const std::size_t row = pixel / to.row_of_tiles();
    const std::size_t row_end = job + std::min((row + 1) * to.row_of_tiles(), pixels_) - pixel;
    if (!to.has_row_of_tiles(row)) {
      job = row_end;
      continue;
    }
    for (; job < std::min(row_end, end); ++job, ++pixel) {
      const film::BlockSum& sum = result.sums[job];
      to.add(pixel, sum, static_cast<std::uint32_t>(samples));
      if (sum.nonfinite > 0) lost.add({static_cast<std::uint64_t>(sum.nonfinite), job, 0, samples});
    }
  }
}

ResultFolder::Jobs ResultFolder::jobs_of(const LaunchResult& result, std::size_t batch) const {
  const auto jobs = static_cast<std::size_t>(result.launch.jobs);
  if (result.batches.empty()) return {0, jobs};
  const std::size_t first = batch * result.batch_jobs;
  return {first, std::min(result.batch_jobs, jobs - first)};
}

// Adds what `to`, the film or a part of it, has of a batch. add_splats() adds the splats.
template<class Target, class AddSplats>
void ResultFolder::fold_batch(const LaunchResult& result, std::size_t batch, Target& to, NotFinite& lost,
                              const AddSplats& add_splats) const {
  const Jobs jobs = jobs_of(result, batch);
  if (!result.sums.empty()) fold_sums(result, jobs, to, lost);
  if (result.batches.empty()) return;
  to.add_splatting_paths(jobs.count * static_cast<std::size_t>(result.launch.block_samples));
  add_splats();
}

ResultFolder::NotFinite ResultFolder::lost_paths(const LaunchResult& result, std::size_t batch,
                                                 const std::vector<std::size_t>& paths) const {
  const auto samples = static_cast<std::size_t>(result.launch.block_samples);
  const std::size_t first = jobs_of(result, batch).first;
  NotFinite lost;
  for (const std::size_t path : paths)
    lost.add({1, first + path / samples, static_cast<int>(path % samples), 1});
  return lost;
}

void ResultFolder::fold_whole(const LaunchResult& result, film::Film& film, NotFinite& lost) {
  for (std::size_t batch = 0; batch < std::max<std::size_t>(result.batches.size(), 1); ++batch)
    fold_batch(result, batch, film, lost, [&] {
      const film::SplatRecords& records = result.batches[batch];
      if (techniques_) film::SplatFolder::fold_techniques(records, film);
      if (!result.merged) splats_.front().merge(records);
      lost.add(lost_paths(result, batch, film::SplatFolder::fold(records, film)));
    });
}

// Each thread divides whole batches first; then it adds its part of all batches.
void ResultFolder::fold_in_parts(const LaunchResult& result, film::Film& film, NotFinite& lost) {
  const std::size_t rows = (pixels_ + film.row_of_tiles() - 1) / film.row_of_tiles();
  const std::size_t threads = std::min({splats_.size(), film::DividedSplats::most_parts, rows});
  const std::size_t batches = result.batches.size();
  std::mutex mutex; // of what all threads have in common
  divided_.begin(result.batches, film, threads);
  in_parallel(threads, batches, [&](std::size_t batch, std::size_t thread) {
    if (!result.merged) splats_[thread].merge(result.batches[batch]);
    const std::vector<std::size_t> paths = divided_.divide(batch);
    const std::lock_guard lock(mutex);
    lost.add(lost_paths(result, batch, paths));
  });
  in_parallel(threads, threads, [&](std::size_t number, std::size_t) {
    film::Film::Part part(film, number, threads);
    NotFinite lost_here;
    for (std::size_t batch = 0; batch < std::max<std::size_t>(batches, 1); ++batch)
      fold_batch(result, batch, part, lost_here, [&] { divided_.add(batch, number, part); });
    const std::lock_guard lock(mutex);
    film.join(part);
    lost.add(lost_here);
  });
  const auto samples = static_cast<std::uint32_t>(result.launch.block_samples);
  film.count_blocks(result.sums.size(), samples);
  if (batches > 0) film.add_splatting_paths(static_cast<std::uint64_t>(result.launch.jobs) * samples);
}

Counts ResultFolder::fold(LaunchResult& result, film::Film& film) {
  if (!result.batches.empty()) film.use_splats();
  const Launch& launch = result.launch;
  Counts counts;
  counts.paths = static_cast<std::uint64_t>(launch.jobs) * static_cast<std::uint64_t>(launch.block_samples);
  counts.rays = result.rays;
  counts.shadow_rays = result.shadow_rays;
  std::size_t additions = result.sums.size();
  for (const film::SplatRecords& batch : result.batches) additions += batch.count;
  constexpr std::size_t worth_dividing = 20'000; // additions, which take about as long as starting threads
  NotFinite lost;
  if (splats_.size() > 1 && additions >= worth_dividing && film.can_be_divided(counts.paths))
    fold_in_parts(result, film, lost);
  else
    fold_whole(result, film, lost);
  counts.nonfinite = lost.count;
  if (lost.count > 0) {
    const std::int64_t place = launch.first_job + static_cast<std::int64_t>(lost.job);
    const auto pixels = static_cast<std::int64_t>(pixels_);
    counts.first_nonfinite = {place % pixels,
                              launch.first_sample + place / pixels * launch.block_samples + lost.sample,
                              lost.samples};
  }
  return counts;
}

} // namespace phlux::render
