#include "render/launcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "errors.h"

namespace phlux::render {
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
      planner_(device.info, parts, settings.launch_seconds),
      pixels_(static_cast<std::int64_t>(scene.camera.width) * scene.camera.height) {
  scene_.bind(kernel_);
  kernel_.set("pixel_count", static_cast<cl_int>(pixels_));
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

bool Launcher::finish() const noexcept {
  try {
    device_.queue.finish();
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
  counts_ = {};
}

bool Launcher::shrink() {
  const bool one_less = !std::exchange(memory_is_short_, true);
  return planner_.shrink(last_jobs_) || one_less;
}

void Launcher::warm_up() {
  Flight flight;
  start(flight);
  device_.queue.finish();
  spare_.push_back(std::move(flight.buffers));
}

void Launcher::enqueue(const Launch& launch) {
  last_jobs_ = launch.jobs;
  Flight& flight = flights_.emplace_back();
  flight.launch = launch;
  if (!spare_.empty()) {
    flight.buffers = std::move(spare_.back());
    spare_.pop_back();
  }
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
    buffer.memory = cl::Buffer(device_.context, CL_MEM_READ_WRITE, bytes);
  } catch (const cl::Error& error) {
    throw MemoryShort(
        fmt::format("{}: no room for the {} of a launch ({} MB): {}: shorten the paths (`max-depth`, "
                    "`rr-depth`)",
                    device_.info.name, what, bytes >> 20, device::error_name(error.err())));
  }
  buffer.bytes = bytes;
}

void Launcher::start(Flight& flight) {
  flight.plan = planner_.plan(flight.launch);
  const Launch& launch = flight.launch;
  const LaunchPlan& plan = flight.plan;
  Buffers& to = flight.buffers;
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
  device_.queue.enqueueNDRangeKernel(kernel_.ready(), cl::NullRange, cl::NDRange(plan.items),
                                     cl::NDRange(plan.local_size), nullptr, &flight.kernel_done);
}

void Launcher::read_back(Flight& flight) {
  flight.copies.clear();
  const auto read = [&](const cl::Buffer& buffer, auto& to, std::size_t count) {
    to.resize(count);
    device_.queue.enqueueReadBuffer(buffer, CL_FALSE, 0, count * sizeof(to[0]), to.data(), nullptr,
                                    &flight.copies.emplace_back());
  };
  const Buffers& from = flight.buffers;
  if (flight.plan.batches > 0) {
    read(from.record_counts.memory, flight.host_record_counts, flight.plan.batches);
    const std::size_t words =
        flight.plan.batches * static_cast<std::size_t>(flight.plan.record_capacity) * record_words(parts_);
    flight.host_records = static_cast<float*>(
        device_.queue.enqueueMapBuffer(from.records.memory, CL_FALSE, CL_MAP_READ | CL_MAP_WRITE, 0,
                                       words * sizeof(float), nullptr, &flight.copies.emplace_back()));
  }
  if (settings::info_of(parts_.integrator).eye_paths)
    read(from.sums.memory, flight.host_sums, static_cast<std::size_t>(flight.launch.jobs));
  read(from.counters.memory, flight.host_counters, flight.plan.items * counters_per_item);
  device_.queue.flush();
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
}

void Launcher::unmap(Flight& flight) {
  if (flight.host_records)
    device_.queue.enqueueUnmapMemObject(flight.buffers.records.memory, flight.host_records);
  flight.host_records = nullptr;
}

// Counts contributions that were not finite, among the given samples of a job's block.
void Launcher::count_nonfinite(const Launch& launch, std::size_t job, std::uint64_t count, int sample,
                               int samples) {
  counts_.nonfinite += count;
  if (counts_.first_nonfinite) return;
  const std::int64_t place = launch.first_job + static_cast<std::int64_t>(job);
  counts_.first_nonfinite = {place % pixels_,
                             launch.first_sample + place / pixels_ * launch.block_samples + sample, samples};
}

void Launcher::fold_sums(const Flight& flight, std::size_t first_job, std::size_t jobs, film::Film& film) {
  const Launch& launch = flight.launch;
  std::int64_t pixel = (launch.first_job + static_cast<std::int64_t>(first_job)) % pixels_;
  for (std::size_t job = first_job; job < first_job + jobs; ++job) {
    const film::BlockSum& sum = flight.host_sums[job];
    film.add(static_cast<std::size_t>(pixel), sum, static_cast<std::uint32_t>(launch.block_samples));
    if (++pixel == pixels_) pixel = 0;
    if (sum.nonfinite > 0)
      count_nonfinite(launch, job, static_cast<std::uint64_t>(sum.nonfinite), 0, launch.block_samples);
  }
}

void Launcher::fold_batch(const Flight& flight, std::size_t batch, film::Film& film) {
  const auto batch_jobs = static_cast<std::size_t>(flight.plan.batch_jobs);
  const auto samples = static_cast<std::size_t>(flight.launch.block_samples);
  const std::size_t first_job = batch * batch_jobs;
  const std::size_t jobs = std::min(batch_jobs, static_cast<std::size_t>(flight.launch.jobs) - first_job);
  if (!flight.host_sums.empty()) fold_sums(flight, first_job, jobs, film);

  const auto capacity = static_cast<std::size_t>(flight.plan.record_capacity);
  film::SplatRecords records;
  records.words = flight.host_records + batch * capacity * record_words(parts_);
  records.capacity = capacity;
  records.count = static_cast<std::size_t>(flight.host_record_counts[batch]);
  records.paths = flight.plan.batch_paths;
  film.add_splatting_paths(jobs * samples);
  if (parts_.techniques) film::SplatFolder::fold_techniques(records, film);
  for (const std::size_t path : folder_.fold(records, film))
    count_nonfinite(flight.launch, first_job + path / samples, 1, static_cast<int>(path % samples), 1);
}

void Launcher::collect(film::Film& film) {
  Flight& flight = flights_.front();
  if (flight.plan.batches > 0) film.use_splats();
  for (std::size_t batch = 0; batch < flight.plan.batches; ++batch) fold_batch(flight, batch, film);
  if (flight.plan.batches == 0) fold_sums(flight, 0, flight.host_sums.size(), film);
  counts_.paths += static_cast<std::uint64_t>(flight.launch.jobs) *
                   static_cast<std::uint64_t>(flight.launch.block_samples);
  for (std::size_t item = 0; item < flight.plan.items; ++item) {
    counts_.rays += flight.host_counters[item * counters_per_item];
    counts_.shadow_rays += flight.host_counters[item * counters_per_item + 1];
  }
  planner_.note_time(flight.launch.jobs * flight.launch.block_samples, seconds_of(flight.kernel_done));
  try {
    unmap(flight);
    spare_.push_back(std::move(flight.buffers));
  } catch (const cl::Error&) { // the film has the launch; buffers that are still mapped are not used again
  }
  flights_.pop_front();
}

} // namespace phlux::render
