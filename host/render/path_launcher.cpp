#include "render/path_launcher.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "errors.h"

namespace phlux::render {
namespace {

// A lane that has run out of paths idles until its work-item ends: with this many paths each, that is a few
// percent.
constexpr std::int64_t least_paths_per_lane = 64;

// Work-items of a launch: on CPUs a few per core, so that cores end together; elsewhere enough to fill every
// unit's registers several times over.
std::size_t work_items(const device::DeviceInfo& info) {
  return static_cast<std::size_t>(info.compute_units) * (info.type == "cpu" ? 4 : 4096);
}

// Jobs of one lane that amount to least_paths_per_lane.
std::int64_t least_lane_jobs(int block_samples) {
  return (least_paths_per_lane + block_samples - 1) / block_samples;
}

constexpr std::size_t local_size_wide = 1, local_size_scalar = 64;

cl_int bounded(int edges) {
  return edges < 0 ? std::numeric_limits<cl_int>::max() : edges;
}

cl_float4 float4_of(const scene::Rgb& rgb) {
  return {{static_cast<float>(rgb.r), static_cast<float>(rgb.g), static_cast<float>(rgb.b), 0.0f}};
}

} // namespace

PathLauncher::PathLauncher(const device::Device& device, const cl::Program& program, const HostScene& scene,
                           const Parts& parts, const Settings& settings)
    : device_(device), scene_(device, scene, parts), kernel_(program, "trace_paths"),
      first_launch_argument_(scene_.bind(kernel_)), lanes_(parts.lanes),
      pixels_(static_cast<std::int64_t>(scene.camera.width) * scene.camera.height),
      launch_seconds_(settings.launch_seconds), units_(device.info.compute_units),
      first_items_(std::max(work_items(device.info) / 64, units_)), items_(work_items(device.info)) {
  const cl_uint2 seed = {{static_cast<cl_uint>(settings.seed), static_cast<cl_uint>(settings.seed >> 32)}};
  cl_uint index = first_launch_argument_;
  kernel_.setArg(index++, static_cast<cl_int>(pixels_));
  index += 5; // what each launch sets
  kernel_.setArg(index++, seed);
  kernel_.setArg(index++, bounded(settings.max_depth));
  kernel_.setArg(index++, bounded(settings.rr_depth));
  kernel_.setArg(index++, float4_of(scene.sky));
  kernel_.setArg(index++, scene.sky_choice);
  kernel_.setArg(index++, static_cast<float>(settings.ambient.value_or(0.0) / scene.lights.unit));
}

std::int64_t PathLauncher::wanted_jobs(std::int64_t left, int block_samples) const {
  // Before anything is measured, one work-item per unit and lane group: what a launch of that takes is known
  // after it.
  std::int64_t jobs = static_cast<std::int64_t>(first_items_) * lanes_ * least_lane_jobs(block_samples);
  if (paths_per_second_ > 0)
    jobs = static_cast<std::int64_t>(paths_per_second_ * launch_seconds_ / block_samples);
  // The kernel counts jobs, and words of their sums, in int.
  constexpr std::int64_t largest = std::numeric_limits<cl_int>::max() / 8;
  return std::clamp(jobs, std::int64_t{lanes_}, std::min(std::max<std::int64_t>(left, lanes_), largest));
}

void PathLauncher::warm_up() {
  start({});
  device_.queue.finish();
}

void PathLauncher::enqueue(const Launch& launch) {
  Flight flight = start(launch);
  read_back(flight);
  flights_.push_back(std::move(flight));
}

PathLauncher::Flight PathLauncher::start(const Launch& launch) {
  Flight flight;
  flight.launch = launch;
  const auto jobs = static_cast<std::size_t>(launch.jobs), lanes = static_cast<std::size_t>(lanes_);
  const std::size_t local = lanes_ == 1 ? local_size_scalar : local_size_wide;
  // As many work-items as give each lane its least number of paths, but one for every unit where there is
  // work for it.
  const auto lane_jobs = static_cast<std::size_t>(least_lane_jobs(launch.block_samples));
  const std::size_t full = jobs / (lanes * lane_jobs), most = (jobs + lanes - 1) / lanes;
  flight.items = std::clamp(std::max(full, std::min(most, units_)), std::size_t{1}, items_);
  flight.items = (flight.items + local - 1) / local * local;
  flight.sums =
      cl::Buffer(device_.context, CL_MEM_WRITE_ONLY, std::max(jobs, std::size_t{1}) * sizeof(film::BlockSum));
  flight.counters = cl::Buffer(device_.context, CL_MEM_WRITE_ONLY, flight.items * 3 * sizeof(cl_uint));
  cl_uint index = first_launch_argument_ + 1;
  kernel_.setArg(index++, static_cast<cl_int>(launch.first_job));
  kernel_.setArg(index++, static_cast<cl_int>(launch.jobs));
  kernel_.setArg(index++, static_cast<cl_int>(launch.first_sample));
  kernel_.setArg(index++, static_cast<cl_int>(launch.block_samples));
  kernel_.setArg(index++, static_cast<cl_int>(launch.end_sample));
  index += 6; // set once
  kernel_.setArg(index++, flight.sums);
  kernel_.setArg(index++, flight.counters);
  device_.queue.enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(flight.items), cl::NDRange(local),
                                     nullptr, &flight.kernel_done);
  return flight;
}

void PathLauncher::read_back(Flight& flight) {
  flight.host_sums.resize(static_cast<std::size_t>(flight.launch.jobs));
  flight.host_counters.resize(flight.items * 3);
  device_.queue.enqueueReadBuffer(flight.sums, CL_FALSE, 0, flight.host_sums.size() * sizeof(film::BlockSum),
                                  flight.host_sums.data(), nullptr, &flight.sums_read);
  device_.queue.enqueueReadBuffer(flight.counters, CL_FALSE, 0, flight.host_counters.size() * sizeof(cl_uint),
                                  flight.host_counters.data(), nullptr, &flight.counters_read);
  device_.queue.flush();
}

void PathLauncher::wait() {
  flights_.front().sums_read.wait();
  flights_.front().counters_read.wait();
}

void PathLauncher::collect(film::Film& film) {
  wait();
  const Flight flight = std::move(flights_.front());
  flights_.pop_front();
  const Launch& launch = flight.launch;
  std::int64_t pixel = launch.first_job, first_sample = launch.first_sample;
  for (const film::BlockSum& sum : flight.host_sums) {
    if (pixel == pixels_) {
      pixel = 0;
      first_sample += launch.block_samples;
    }
    const std::int64_t samples =
        std::min<std::int64_t>(launch.block_samples, launch.end_sample - first_sample);
    film.add(static_cast<std::size_t>(pixel++), sum, static_cast<std::uint32_t>(samples));
    counts_.paths += static_cast<std::uint64_t>(samples);
  }
  for (std::size_t item = 0; item < flight.items; ++item) {
    counts_.rays += flight.host_counters[item * 3];
    counts_.shadow_rays += flight.host_counters[item * 3 + 1];
    counts_.nonfinite += flight.host_counters[item * 3 + 2];
  }
  adapt(flight);
}

void PathLauncher::adapt(const Flight& flight) {
  const cl_ulong begin = flight.kernel_done.getProfilingInfo<CL_PROFILING_COMMAND_START>();
  const cl_ulong end = flight.kernel_done.getProfilingInfo<CL_PROFILING_COMMAND_END>();
  const double seconds = static_cast<double>(end - begin) * 1e-9;
  if (seconds <= 0) return;
  const double rate = static_cast<double>(flight.launch.jobs * flight.launch.block_samples) / seconds;
  // Grow by no more than 4 times at once: a first launch may have been unrepresentative.
  paths_per_second_ = paths_per_second_ > 0 ? std::min(rate, 4 * paths_per_second_) : rate;
}

} // namespace phlux::render
