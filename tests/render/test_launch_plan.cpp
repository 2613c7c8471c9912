// Planning of launches, without a device.
#include <catch2/catch.hpp>

#include "render/launch_plan.h"

using namespace phlux;
using namespace phlux::render;

namespace {

device::DeviceInfo processor() {
  device::DeviceInfo info;
  info.type = "cpu";
  info.compute_units = 4;
  info.largest_buffer = std::size_t{1} << 30;
  info.global_memory = std::size_t{1} << 32;
  return info;
}

Parts parts_for(Integrator integrator, int lanes = 8) {
  Parts parts;
  parts.integrator = integrator;
  parts.lanes = lanes;
  return parts;
}

Launch launch_of(std::int64_t jobs) {
  Launch launch;
  launch.jobs = jobs;
  return launch;
}

constexpr std::int64_t many = 1'000'000'000;

} // namespace

TEST_CASE(
    "launches get as many jobs as last the time that they should, but no more than four times as many") {
  Planner planner(processor(), parts_for(Integrator::path), 0.5);
  const std::int64_t first = planner.pace().wanted_jobs(many, samples_per_block);
  planner.note_time(first * samples_per_block, 0.125);
  CHECK(planner.pace().wanted_jobs(many, samples_per_block) == 4 * first);
  planner.note_time(first * samples_per_block, 0.125 / 16);
  CHECK(planner.pace().wanted_jobs(many, samples_per_block) == 16 * first);
  CHECK(planner.pace().wanted_jobs(100, samples_per_block) == 100);
}

TEST_CASE("launches of paths that splat have whole batches") {
  Planner planner(processor(), parts_for(Integrator::light), 0.05);
  const LaunchPlan plan = planner.plan(launch_of(planner.pace().wanted_jobs(1, samples_per_block)));
  CHECK(plan.batches == 1);
  CHECK(plan.batch_paths == static_cast<std::size_t>(plan.batch_jobs * samples_per_block));
  CHECK(planner.pace().wanted_jobs(many, samples_per_block) % plan.batch_jobs == 0);
  CHECK(plan.scratch_bytes == 0);
}

TEST_CASE("buffers that were too small grow") {
  Planner planner(processor(), parts_for(Integrator::bidir), 0.05);
  const LaunchPlan first = planner.plan(launch_of(1000));
  std::vector<cl_int> counts(first.batches, first.record_capacity / 2);
  CHECK_FALSE(planner.overflowed(first, counts));

  counts.front() = 2 * first.record_capacity;
  REQUIRE(planner.overflowed(first, counts));
  const LaunchPlan second = planner.plan(launch_of(1000));
  CHECK(second.record_capacity > counts.front());
  CHECK_FALSE(planner.overflowed(second, counts));
  CHECK(second.rows == first.rows);

  counts.front() = -1; // vertices
  REQUIRE(planner.overflowed(second, counts));
  CHECK(planner.plan(launch_of(1000)).rows == 2 * first.rows);
}

TEST_CASE("the vertices of a launch fit a buffer, where one group's do") {
  device::DeviceInfo gpu = processor();
  gpu.type = "gpu";
  const Planner planner(gpu, parts_for(Integrator::bidir, 1), 0.05);
  const LaunchPlan plan = planner.plan(launch_of(10'000'000));
  CHECK(plan.local_size == 64);
  CHECK(plan.items % plan.local_size == 0);
  CHECK(plan.scratch_bytes <= gpu.largest_buffer / 2);
  gpu.largest_buffer = 1 << 16;
  CHECK(Planner(gpu, parts_for(Integrator::bidir, 1), 0.05).plan(launch_of(10'000'000)).items == 64);
}

TEST_CASE("after a launch without memory, launches and their buffers are smaller, down to one group") {
  Planner planner(processor(), parts_for(Integrator::bidir), 0.05);
  planner.note_time(1'000'000, 0.05);
  std::int64_t jobs = planner.pace().wanted_jobs(many, samples_per_block);
  LaunchPlan plan = planner.plan(launch_of(jobs));
  int times = 0;
  for (; planner.shrink(jobs); ++times) {
    const std::int64_t fewer = planner.pace().wanted_jobs(many, samples_per_block);
    const LaunchPlan smaller = planner.plan(launch_of(fewer));
    CHECK((fewer < jobs || smaller.items < plan.items));
    CHECK(smaller.scratch_bytes <= plan.scratch_bytes);
    jobs = fewer;
    plan = smaller;
  }
  CHECK(times > 3);
  CHECK(plan.items == plan.local_size);
}
