#include "render/launcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "device/buffer.h"
#include "errors.h"

namespace phlux::render {

std::string name_of(const device::DeviceInfo& device) {
  return fmt::format("OpenCL device {}:{} ({})", device.platform_index, device.device_index, device.name);
}

namespace {

constexpr std::size_t counters_per_item = 2; // rays, shadow rays

cl_int bounded(int edges) {
  return edges < 0 ? std::numeric_limits<cl_int>::max() : edges;
}

// 0 if the driver does not say: the film does not need it.
double seconds_of(const cl::Event& kernel_done) try {
  const cl_ulong begin = kernel_done.getProfilingInfo<CL_PROFILING_COMMAND_START>();
  const cl_ulong end = kernel_done.getProfilingInfo<CL_PROFILING_COMMAND_END>();
  return static_cast<double>(end - begin) * 1e-9;
} catch (const cl::Error&) {
  return 0.0;
}

// Drivers may report a failure by the command's event alone.
void check(const cl::Event& event, const char* what) {
  const cl_int status = event.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>();
  if (status < 0) throw cl::Error(status, what);
}

} // namespace

Launcher::Launcher(const device::Device& device, const device::BuiltProgram& program, const HostScene& scene,
                   const Parts& parts, const Settings& settings)
    : device_(device), scene_(device, scene, parts), parts_(parts),
      kernel_(program, settings::info_of(parts.integrator).kernel),
      planner_(device.info, parts, settings.launch_seconds) {
  scene_.bind(kernel_);
  kernel_.set("pixel_count", static_cast<cl_int>(scene.camera.width * scene.camera.height));
  kernel_.set("max_edges", bounded(settings.max_depth));
  kernel_.set("roulette_edges", bounded(settings.rr_depth));
  kernel_.set("sky_light", static_cast<cl_int>(std::max(scene.lights.sky, 0)));
  kernel_.set("ambient", static_cast<cl_float>(settings.ambient
                                                   ? in_units("ambient", *settings.ambient, scene.lights.unit)
                                                   : 0.0));
  begin(settings);
}

void Launcher::begin(const Settings& settings) {
  kernel_.set("seed",
              cl_uint2{{static_cast<cl_uint>(settings.seed), static_cast<cl_uint>(settings.seed >> 32)}});
  first_sample_ = settings.first_sample;
  // Two launches are in flight when the time is over.
  planner_.set_launch_seconds(std::min(settings.launch_seconds, settings.time_limit.value_or(INFINITY) / 40));
}

Launcher::Slot Launcher::spare_slot() {
  if (spare_.empty()) return {.queue = device::make_queue(device_.context, device_.handle)};
  Slot slot = std::move(spare_.back());
  spare_.pop_back();
  return slot;
}

bool Launcher::finish() const noexcept {
  try {
    for (const Flight& flight : flights_) flight.slot.queue.finish();
    return true;
  } catch (const cl::Error&) {
    return false;
  }
}

void Launcher::abandon() noexcept {
  const bool idle = finish() || finish();
  for (Flight& flight : flights_) {
    try {
      unmap(flight);
    } catch (const cl::Error&) { // the driver keeps the buffer
    }
  }
  static_cast<void>(finish());
  // A device that does not finish may yet write: the memory is kept for the life of the process.
  if (!idle) new std::deque<Flight>(std::move(flights_));
  flights_.clear();
  spare_.clear();
}

bool Launcher::shrink() {
  const bool one_less = !std::exchange(memory_is_short_, true);
  return planner_.shrink(last_jobs_) || one_less;
}

void Launcher::warm_up() {
  Flight flight;
  flight.slot = spare_slot();
  start(flight);
  flight.slot.queue.finish();
  spare_.push_back(std::move(flight.slot));
}

void Launcher::enqueue(const Launch& launch) {
  last_jobs_ = launch.jobs;
  Slot slot = spare_slot();
  Flight& flight = flights_.emplace_back();
  flight.result.launch = launch;
  flight.slot = std::move(slot);
  start(flight);
  read_back(flight);
}

void Launcher::reserve(Buffer& buffer, std::size_t bytes, const char* what) const {
  bytes = std::max(bytes, sizeof(cl_float));
  if (bytes <= buffer.bytes) return;
  if (bytes > device_.info.largest_buffer)
    throw MemoryShort(
        fmt::format("{}: the {} of a launch take {} MB and a buffer may have {} MB: shorten the paths "
                    "(`max-depth`, `rr-depth`)",
                    device_.info.name, what, bytes >> 20, device_.info.largest_buffer >> 20));
  buffer = {}; // released before the new one is allocated, as memory may be short
  try {
    buffer.memory = device::make_buffer(device_, CL_MEM_READ_WRITE, bytes);
  } catch (const cl::Error& error) {
    throw MemoryShort(
        fmt::format("{}: no room for the {} of a launch ({} MB): {}: shorten the paths (`max-depth`, "
                    "`rr-depth`)",
                    device_.info.name, what, bytes >> 20, device::error_name(error.err())));
  }
  buffer.bytes = bytes;
}

void Launcher::start(Flight& flight) {
  const Launch& launch = flight.result.launch;
  flight.plan = planner_.plan(launch);
  const LaunchPlan& plan = flight.plan;
  Slot& to = flight.slot;
  kernel_.set("first_pixel", static_cast<cl_int>(launch.first_job));
  kernel_.set("job_count", static_cast<cl_int>(launch.jobs));
  kernel_.set("first_sample", static_cast<cl_int>(launch.first_sample));
  kernel_.set("block_samples", static_cast<cl_int>(launch.block_samples));
  kernel_.set("point_sets",
              cl_uint2{{static_cast<cl_uint>(first_sample_),
                        static_cast<cl_uint>(point_bits(launch.first_sample - first_sample_))}});
  kernel_.set("batch_jobs", static_cast<cl_int>(plan.batch_jobs));
  kernel_.set("record_words", static_cast<cl_int>(record_words(parts_)));
  kernel_.set("record_capacity", static_cast<cl_int>(plan.record_capacity));
  kernel_.set("rows", static_cast<cl_int>(plan.rows));
  const auto set = [&](const char* argument, Buffer& buffer, std::size_t bytes, const char* what) {
    reserve(buffer, bytes, what);
    kernel_.set(argument, buffer.memory);
  };
  set("counters", to.counters, plan.items * counters_per_item * sizeof(cl_uint), "counters");
  const settings::IntegratorInfo& integrator = settings::info_of(parts_.integrator);
  if (integrator.eye_paths)
    set("sums", to.sums, static_cast<std::size_t>(launch.jobs) * sizeof(film::BlockSum), "sums");
  if (integrator.light_paths) {
    const auto capacity = static_cast<std::size_t>(plan.record_capacity);
    set("records", to.records, plan.batches * capacity * record_words(parts_) * sizeof(float), "splats");
    set("record_counts", to.record_counts, plan.batches * sizeof(cl_int), "counts of splats");
  }
  if (integrator.bidirectional()) set("scratch", to.scratch, plan.scratch_bytes, "vertices");
  to.queue.enqueueNDRangeKernel(kernel_.ready(), cl::NullRange, cl::NDRange(plan.items),
                                cl::NDRange(plan.local_size), nullptr, &flight.kernel_done);
}

void Launcher::read_back(Flight& flight) {
  flight.copies.clear();
  const auto read = [&](const cl::Buffer& buffer, auto& to, std::size_t count) {
    to.resize(count);
    flight.slot.queue.enqueueReadBuffer(buffer, CL_FALSE, 0, count * sizeof(to[0]), to.data(), nullptr,
                                        &flight.copies.emplace_back());
  };
  const Slot& from = flight.slot;
  if (flight.plan.batches > 0) {
    read(from.record_counts.memory, flight.host_record_counts, flight.plan.batches);
    const std::size_t words =
        flight.plan.batches * static_cast<std::size_t>(flight.plan.record_capacity) * record_words(parts_);
    flight.host_records = static_cast<float*>(
        from.queue.enqueueMapBuffer(from.records.memory, CL_FALSE, CL_MAP_READ | CL_MAP_WRITE, 0,
                                    words * sizeof(float), nullptr, &flight.copies.emplace_back()));
  }
  if (settings::info_of(parts_.integrator).eye_paths)
    read(from.sums.memory, flight.result.sums, static_cast<std::size_t>(flight.result.launch.jobs));
  read(from.counters.memory, flight.host_counters, flight.plan.items * counters_per_item);
  from.queue.flush();
}

void Launcher::wait(const Flight& flight) {
  cl::Event::waitForEvents(flight.copies);
  check(flight.kernel_done, "kernel");
  for (const cl::Event& copy : flight.copies) check(copy, "reading a launch's results");
}

void Launcher::settle() {
  Flight& flight = flights_.front();
  wait(flight);
  while (planner_.overflowed(flight.plan, flight.host_record_counts)) {
    unmap(flight);
    start(flight);
    read_back(flight);
    wait(flight);
  }
  LaunchResult& result = flight.result;
  result.batch_jobs = static_cast<std::size_t>(flight.plan.batch_jobs);
  result.record_words = record_words(parts_);
  const auto capacity = static_cast<std::size_t>(flight.plan.record_capacity);
  result.batches.clear();
  for (std::size_t batch = 0; batch < flight.plan.batches; ++batch)
    result.batches.push_back({.words = flight.host_records + batch * capacity * result.record_words,
                              .capacity = capacity,
                              .count = static_cast<std::size_t>(flight.host_record_counts[batch]),
                              .paths = flight.plan.batch_paths});
  result.rays = result.shadow_rays = 0;
  for (std::size_t item = 0; item < flight.plan.items; ++item) {
    result.rays += flight.host_counters[item * counters_per_item];
    result.shadow_rays += flight.host_counters[item * counters_per_item + 1];
  }
  planner_.note_time(result.launch.jobs * result.launch.block_samples, seconds_of(flight.kernel_done));
}

void Launcher::unmap(Flight& flight) {
  if (flight.host_records)
    flight.slot.queue.enqueueUnmapMemObject(flight.slot.records.memory, flight.host_records);
  flight.host_records = nullptr;
}

void Launcher::release() noexcept {
  Flight& flight = flights_.front();
  try {
    unmap(flight);
    spare_.push_back(std::move(flight.slot));
  } catch (const std::exception&) { // the launch is done; buffers that are still mapped are not used again
  }
  flights_.pop_front();
}

LaunchResult Launcher::detach() {
  LaunchResult& result = flights_.front().result;
  if (!result.batches.empty()) own_batches(result);
  LaunchResult own = std::move(result);
  release();
  return own;
}

std::string Launcher::name() const {
  return name_of(device_.info);
}

} // namespace phlux::render
