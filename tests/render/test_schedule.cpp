// Division of samples into launches, and resuming a schedule.
#include "render/schedule.h"

#include <bit>
#include <map>

#include <catch2/catch.hpp>

using namespace phlux::render;

namespace {

constexpr std::int64_t pixels = 7;

// A block of samples of one pixel, which the film adds in one step.
struct Job {
  std::int64_t pixel, first_sample;
  int samples;
  bool operator==(const Job&) const = default;
};

// `most` launches of at most `jobs` jobs.
std::vector<Job> jobs_of(Schedule& schedule, std::int64_t jobs, int most = 1000) {
  std::vector<Job> all;
  for (int i = 0; i < most; ++i) {
    const auto launch = schedule.next([&](std::int64_t, int) { return jobs; });
    if (!launch) break;
    REQUIRE(launch->first_job < pixels);
    for (std::int64_t job = launch->first_job; job < launch->first_job + launch->jobs; ++job)
      all.push_back(
          {job % pixels, launch->first_sample + job / pixels * launch->block_samples, launch->block_samples});
  }
  return all;
}

// Samples of every pixel, each of which must occur once at most.
std::vector<std::vector<int>> samples_in(const std::vector<Job>& jobs) {
  std::vector<std::vector<int>> counts(pixels);
  for (const Job& job : jobs) {
    auto& count = counts[static_cast<std::size_t>(job.pixel)];
    const auto end = static_cast<std::size_t>(job.first_sample + job.samples);
    if (count.size() < end) count.resize(end);
    for (auto i = static_cast<std::size_t>(job.first_sample); i < end; ++i) ++count[i];
  }
  return counts;
}

} // namespace

TEST_CASE("a schedule goes on where another stopped with the jobs that were to come, in their order") {
  const std::optional<std::int64_t> samples = GENERATE(std::optional<std::int64_t>(), 8, 16, 75);
  const int most = samples ? 1000 : 60;
  for (const std::int64_t length : {1, 3, 7, 10}) {
    Schedule whole(pixels, samples);
    const std::vector<Job> all = jobs_of(whole, length, most);
    for (int launches = 0; launches <= 40; launches += 3) {
      CAPTURE(samples.value_or(0), length, launches);
      Schedule first(pixels, samples);
      std::vector<Job> jobs = jobs_of(first, length, launches);
      Schedule second(pixels, samples, first.position());
      const std::vector<Job> rest = jobs_of(second, length, most);
      jobs.insert(jobs.end(), rest.begin(), rest.end());
      jobs.resize(std::min(jobs.size(), all.size())); // without a limit the two end at different jobs
      CHECK(jobs == std::vector<Job>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(jobs.size())));
    }
  }
}

TEST_CASE("missing samples are scheduled first, however they are divided") {
  SchedulePosition position{32, 5, samples_per_block, {{3, 10, 16, 16}, {6, 2, 32, 16}}};
  Schedule schedule(pixels, 64, position);
  const std::vector<Job> jobs = jobs_of(schedule, 4);
  CHECK(jobs.front() == Job{3, 16, 16});
  CHECK(jobs[4] == Job{0, 32, 16});
  CHECK(jobs[10] == Job{6, 32, 16});
  CHECK(jobs[11] == Job{0, 48, 16});
  CHECK(jobs[12] == Job{5, 32, 16});
  CHECK(jobs.size() == 12 + 2 + pixels);

  Schedule begun(pixels, 64, position);
  CHECK(jobs_of(begun, 4, 2).size() == 8);
  const SchedulePosition later = begun.position();
  REQUIRE(later.missing.size() == 2);
  CHECK(later.missing[0].first_job == 4);
  CHECK(later.missing[0].jobs == 2);
  CHECK(later.missing[0].first_sample == 32);
  CHECK(later.sample == 32);
  CHECK(later.pixel == 5);
}

TEST_CASE("a schedule with another number of samples goes on without a gap and without repeating any") {
  const std::optional<std::int64_t> before = GENERATE(std::optional<std::int64_t>(), 5, 20, 32);
  for (const std::int64_t after : {32, 37, 64, 100})
    for (int launches = 1; launches <= 11; ++launches) {
      CAPTURE(before.value_or(0), after, launches);
      Schedule first(pixels, before);
      std::vector<Job> jobs = jobs_of(first, 4, launches);
      const SchedulePosition position = first.position();
      if (position.end() > after) continue;
      Schedule second(pixels, after, position);
      const std::vector<Job> rest = jobs_of(second, 5);
      jobs.insert(jobs.end(), rest.begin(), rest.end());
      const std::vector<int> once(static_cast<std::size_t>(after), 1);
      CHECK(samples_in(jobs) == std::vector<std::vector<int>>(pixels, once));
      // Whole blocks again as soon as possible.
      for (const Job& job : rest)
        CHECK((job.samples == samples_per_block || job.first_sample == position.sample ||
               job.first_sample % samples_per_block != 0 || job.first_sample + job.samples == after));
    }
}

TEST_CASE("a schedule without an end goes on from every position that a finite one can have, up to the last "
          "sample") {
  const std::int64_t most = phlux::settings::most_samples, begin = most - 40;
  for (const Blocks blocks : {Blocks::of_independent, Blocks::of_point_sets}) {
    Schedule schedule(pixels, std::nullopt, {begin, 0, samples_per_block, {}}, blocks);
    std::int64_t next = begin;
    for (const Job& job : jobs_of(schedule, 3))
      if (job.pixel == 0) {
        CHECK(job.first_sample == next);
        next += job.samples;
      }
    CHECK(next == most);
  }
}

TEST_CASE("point sets grow with the number of samples") {
  Schedule schedule(1, 1100, {}, Blocks::of_point_sets);
  std::int64_t next = 0;
  std::map<int, int> counts; // of blocks, by length
  double squares = 0.0;
  for (std::int64_t done = 0; const auto launch = schedule.next([](std::int64_t, int) { return 1; });) {
    CHECK(launch->first_sample == next);
    const int length = 1 << point_bits(next);
    CHECK(next % length == 0);
    CHECK(launch->block_samples == std::min<std::int64_t>(length, 1100 - next));
    next += launch->block_samples;
    ++counts[launch->block_samples];
    squares += launch->block_samples * launch->block_samples;
    done = next;
    if (std::has_single_bit(static_cast<std::uint64_t>(done)) && done >= 16)
      CHECK(static_cast<double>(done * done) / squares >= 16.0); // blocks of equal length that tell as much
  }
  CHECK(next == 1100);
  CHECK(counts == std::map<int, int>{{1, 16}, {2, 8}, {4, 8}, {8, 8}, {16, 8}, {32, 8}, {64, 9}, {12, 1}});
}

TEST_CASE("a schedule of point sets goes on where another stopped") {
  for (const std::int64_t before : {5, 20, 32, 100, 600})
    for (const std::int64_t after : {600, 1000})
      for (int launches = 1; launches <= 40; ++launches) {
        CAPTURE(before, after, launches);
        Schedule first(pixels, before, {}, Blocks::of_point_sets);
        std::vector<Job> jobs = jobs_of(first, 4, launches);
        Schedule second(pixels, after, first.position(), Blocks::of_point_sets);
        const std::vector<Job> rest = jobs_of(second, 5);
        jobs.insert(jobs.end(), rest.begin(), rest.end());
        const std::vector<int> once(static_cast<std::size_t>(after), 1);
        CHECK(samples_in(jobs) == std::vector<std::vector<int>>(pixels, once));
        for (const Job& job : rest) { // no block is in two sets
          const int length = 1 << point_bits(job.first_sample);
          CHECK(job.first_sample / length == (job.first_sample + job.samples - 1) / length);
        }
      }
}
