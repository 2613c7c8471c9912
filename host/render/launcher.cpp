#include "render/launcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "errors.h"

namespace phlux::render {
namespace {

// A lane that has run out of paths idles until its work-item (or its batch) ends: with this many paths each,
// that is a few percent. On a GPU, whose lanes are work-items, fewer keep the batches' vertices small.
constexpr int least_paths_wide = 64, least_paths_scalar = 16;

constexpr std::size_t counters_per_item = 2; // rays, shadow rays

// Work-items of a launch: on CPUs a few per core, so that cores end together; elsewhere enough to fill every
// unit's registers several times over.
std::size_t work_items(const device::DeviceInfo& info) {
  return static_cast<std::size_t>(info.compute_units) * (info.type == "cpu" ? 4 : 4096);
}

// Jobs of one lane that amount to its least number of paths.
int least_lane_jobs(int lanes, int block_samples) {
  const int paths = lanes == 1 ? least_paths_scalar : least_paths_wide;
  return (paths + block_samples - 1) / block_samples;
}

const char* kernel_name(Integrator integrator) {
  switch (integrator) {
  case Integrator::light:
    return "trace_light";
  case Integrator::bidir:
    return "trace_bidir";
  default:
    return "trace_paths";
  }
}

cl_int bounded(int edges) {
  return edges < 0 ? std::numeric_limits<cl_int>::max() : edges;
}

int vertex_words(const Parts& parts) {
  return parts.anisotropic ? VERTEX_WORDS_MOST : parts.smooth_normals ? VERTEX_TANGENT : VERTEX_GEOMETRIC;
}

// Of what a bidirectional work-item keeps: kernels/lanes.h's Scalar.
std::size_t scalar_bytes(const Parts& parts) {
  return parts.double_precision ? sizeof(cl_double) : sizeof(cl_float);
}

std::size_t record_words(const Parts& parts) {
  return parts.techniques ? RECORD_TECHNIQUE + 1 : RECORD_VALUE + 3;
}

} // namespace

Launcher::Launcher(const device::Device& device, const cl::Program& program, const HostScene& scene,
                   const Parts& parts, const Settings& settings)
    : device_(device), scene_(device, scene, parts), kernel_(program, kernel_name(parts.integrator)),
      first_launch_argument_(scene_.bind(kernel_)), parts_(parts), lanes_(parts.lanes),
      local_size_(lanes_ == 1 ? 64 : 1), sky_light_(std::max(scene.lights.constant, 0)),
      pixels_(static_cast<std::int64_t>(scene.camera.width) * scene.camera.height),
      launch_seconds_(settings.launch_seconds), units_(device.info.compute_units),
      first_items_(std::max(work_items(device.info) / 64, units_)), items_(work_items(device.info)) {
  const cl_uint2 seed = {{static_cast<cl_uint>(settings.seed), static_cast<cl_uint>(settings.seed >> 32)}};
  cl_uint index = first_launch_argument_;
  kernel_.setArg(index++, static_cast<cl_int>(pixels_));
  index += 4; // what each launch sets
  kernel_.setArg(index++, seed);
  kernel_.setArg(index++, bounded(settings.max_depth));
  kernel_.setArg(index++, bounded(settings.rr_depth));
  if (parts_.integrator == Integrator::path)
    kernel_.setArg(index + 2, static_cast<float>(settings.ambient.value_or(0.0) / scene.lights.unit));
}

Launcher::~Launcher() {
  try {
    device_.queue.finish();
  } catch (const cl::Error&) { // a device that has failed writes no more
  }
}

int Launcher::batch_jobs(int block_samples) const {
  return lanes_ * least_lane_jobs(lanes_, block_samples);
}

std::int64_t Launcher::wanted_jobs(std::int64_t left, int block_samples) const {
  const std::int64_t least = batch_jobs(block_samples);
  // Before anything is measured, one batch per work-item: what a launch of that takes is known after it.
  std::int64_t jobs = static_cast<std::int64_t>(first_items_) * least;
  if (paths_per_second_ > 0)
    jobs = static_cast<std::int64_t>(paths_per_second_ * launch_seconds_ / block_samples);
  // The kernel counts jobs, and words of their sums, in int; a launch's records must fit a buffer.
  std::int64_t largest = std::numeric_limits<cl_int>::max() / 8;
  if (parts_.integrator != Integrator::path) {
    const double bytes_per_job =
        (records_per_path_ + 1) * block_samples * static_cast<double>(record_words(parts_) * sizeof(float));
    largest = std::min(largest, static_cast<std::int64_t>(static_cast<double>(device_.info.largest_buffer) /
                                                          (4 * bytes_per_job)));
  }
  jobs = std::clamp(jobs, std::int64_t{lanes_}, std::min(std::max<std::int64_t>(left, lanes_), largest));
  // Whole batches, so that batches are the same however the work is cut.
  return parts_.integrator == Integrator::path ? jobs : (jobs + least - 1) / least * least;
}

void Launcher::warm_up() {
  Flight flight;
  start(flight);
  device_.queue.finish();
  spare_.push_back(std::move(flight.buffers));
}

void Launcher::enqueue(const Launch& launch) {
  Flight& flight = flights_.emplace_back();
  flight.launch = launch;
  if (!spare_.empty()) {
    flight.buffers = std::move(spare_.back());
    spare_.pop_back();
  }
  start(flight);
  read_back(flight);
}

// See divide_scratch in kernels/bidir.cl.
std::size_t Launcher::scratch_bytes_per_item(const Flight& flight) const {
  const auto vertices = static_cast<std::size_t>(flight.rows) * static_cast<std::size_t>(lanes_);
  return (2 * vertices * static_cast<std::size_t>(vertex_words(parts_)) +
          SCRATCH_WORDS_PER_PATH * flight.batch_paths()) *
         scalar_bytes(parts_);
}

// How many work-items, how many batches, and what room each has.
void Launcher::plan(Flight& flight) const {
  const auto jobs = static_cast<std::size_t>(flight.launch.jobs), lanes = static_cast<std::size_t>(lanes_);
  flight.batch_jobs = batch_jobs(flight.launch.block_samples);
  const auto per_batch = static_cast<std::size_t>(flight.batch_jobs);
  if (parts_.integrator == Integrator::path) {
    // As many work-items as give each lane its least number of paths, but one for every unit where there is
    // work for it.
    const std::size_t full = jobs / per_batch, most = (jobs + lanes - 1) / lanes;
    flight.items = std::clamp(std::max(full, std::min(most, units_)), std::size_t{1}, items_);
  } else {
    flight.batches = (jobs + per_batch - 1) / per_batch;
    flight.items = std::clamp(flight.batches, std::size_t{1}, items_);
    const double lane_paths = static_cast<double>(flight.batch_paths()) / lanes_;
    flight.rows = static_cast<int>(std::ceil(rows_per_path_ * lane_paths));
    flight.record_capacity = static_cast<int>(std::ceil(records_per_path_ * lane_paths)) * lanes_ + lanes_;
    if (parts_.integrator == Integrator::bidir) {
      // Two launches are in flight, and other tables want room.
      const std::size_t room = std::min(device_.info.largest_buffer / 2, device_.info.global_memory / 8);
      const std::size_t fit = room / scratch_bytes_per_item(flight);
      flight.items =
          std::clamp(flight.items, std::size_t{1}, std::max(fit / local_size_ * local_size_, local_size_));
    }
  }
  flight.items = (flight.items + local_size_ - 1) / local_size_ * local_size_;
}

void Launcher::reserve(Buffer& buffer, std::size_t bytes, const char* what) const {
  bytes = std::max(bytes, sizeof(cl_float));
  if (bytes <= buffer.bytes) return;
  if (bytes > device_.info.largest_buffer)
    throw DeviceError(
        fmt::format("{}: the {} of a launch take {} MB and a buffer may have {} MB: shorten the paths "
                    "(--max-depth, --rr-depth)",
                    device_.info.name, what, bytes >> 20, device_.info.largest_buffer >> 20));
  buffer = {}; // before there is another: memory may be short
  try {
    buffer.memory = cl::Buffer(device_.context, CL_MEM_READ_WRITE, bytes);
  } catch (const cl::Error& error) {
    throw DeviceError(
        fmt::format("{}: no room for the {} of a launch ({} MB): {}: shorten the paths (--max-depth, "
                    "--rr-depth)",
                    device_.info.name, what, bytes >> 20, device::error_name(error.err())));
  }
  buffer.bytes = bytes;
}

void Launcher::start(Flight& flight) {
  plan(flight);
  const Launch& launch = flight.launch;
  Buffers& to = flight.buffers;
  const bool batches = parts_.integrator != Integrator::path;
  const bool sums = parts_.integrator != Integrator::light;
  reserve(to.counters, flight.items * counters_per_item * sizeof(cl_uint), "counters");
  if (sums) reserve(to.sums, static_cast<std::size_t>(launch.jobs) * sizeof(film::BlockSum), "sums");
  cl_uint index = first_launch_argument_ + 1;
  const auto set = [&](const auto& value) { kernel_.setArg(index++, value); };
  set(static_cast<cl_int>(launch.first_job));
  set(static_cast<cl_int>(launch.jobs));
  set(static_cast<cl_int>(launch.first_sample));
  set(static_cast<cl_int>(launch.block_samples));
  index += 3; // set once
  set(to.counters.memory);
  if (batches) {
    const auto capacity = static_cast<std::size_t>(flight.record_capacity);
    reserve(to.records, flight.batches * capacity * record_words(parts_) * sizeof(float), "splats");
    reserve(to.record_counts, flight.batches * sizeof(cl_int), "counts of splats");
    set(static_cast<cl_int>(flight.batch_jobs));
    set(static_cast<cl_int>(record_words(parts_)));
    set(static_cast<cl_int>(flight.record_capacity));
    set(to.records.memory);
    set(to.record_counts.memory);
  }
  if (parts_.integrator != Integrator::light) set(static_cast<cl_int>(sky_light_));
  if (parts_.integrator == Integrator::bidir) {
    reserve(to.scratch, flight.items * scratch_bytes_per_item(flight), "vertices");
    set(static_cast<cl_int>(flight.rows));
    set(to.scratch.memory);
  }
  if (parts_.integrator == Integrator::path) ++index; // the ambient radiance, set once
  if (sums) set(to.sums.memory);
  device_.queue.enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(flight.items),
                                     cl::NDRange(local_size_), nullptr, &flight.kernel_done);
}

void Launcher::read_back(Flight& flight) {
  const auto read = [&](const cl::Buffer& buffer, auto& to, std::size_t count) {
    to.resize(count);
    device_.queue.enqueueReadBuffer(buffer, CL_FALSE, 0, count * sizeof(to[0]), to.data(), nullptr,
                                    &flight.read);
  };
  const Buffers& from = flight.buffers;
  if (flight.batches > 0) {
    read(from.record_counts.memory, flight.host_record_counts, flight.batches);
    const std::size_t words =
        flight.batches * static_cast<std::size_t>(flight.record_capacity) * record_words(parts_);
    flight.host_records = static_cast<float*>(
        device_.queue.enqueueMapBuffer(from.records.memory, CL_FALSE, CL_MAP_READ | CL_MAP_WRITE, 0,
                                       words * sizeof(float), nullptr, &flight.read));
  }
  if (parts_.integrator != Integrator::light)
    read(from.sums.memory, flight.host_sums, static_cast<std::size_t>(flight.launch.jobs));
  read(from.counters.memory, flight.host_counters, flight.items * counters_per_item);
  device_.queue.flush();
}

void Launcher::settle() {
  Flight& flight = flights_.front();
  flight.read.wait();
  while (overflowed(flight)) {
    unmap(flight);
    start(flight);
    read_back(flight);
    flight.read.wait();
  }
}

void Launcher::unmap(Flight& flight) {
  if (flight.host_records)
    device_.queue.enqueueUnmapMemObject(flight.buffers.records.memory, flight.host_records);
  flight.host_records = nullptr;
}

// Whether some batch had more vertices or splats than there was room for; makes more room for the next try.
bool Launcher::overflowed(const Flight& flight) {
  if (flight.batches == 0) return false;
  const int most = std::ranges::max(flight.host_record_counts);
  const bool splats = most > flight.record_capacity - lanes_;
  const bool vertices = std::ranges::min(flight.host_record_counts) < 0;
  if (splats) {
    const auto paths = static_cast<double>(flight.batch_paths());
    records_per_path_ = std::max(records_per_path_, 1.25 * most / paths);
  }
  if (vertices) {
    const double lane_paths = static_cast<double>(flight.batch_paths()) / lanes_;
    rows_per_path_ = std::max(rows_per_path_, 2 * flight.rows / lane_paths);
  }
  return splats || vertices;
}

// Notes what was not finite among the given samples of a job's block.
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
  const auto batch_jobs = static_cast<std::size_t>(flight.batch_jobs);
  const auto samples = static_cast<std::size_t>(flight.launch.block_samples);
  const std::size_t first_job = batch * batch_jobs;
  const std::size_t jobs = std::min(batch_jobs, static_cast<std::size_t>(flight.launch.jobs) - first_job);
  if (!flight.host_sums.empty()) fold_sums(flight, first_job, jobs, film);

  const auto capacity = static_cast<std::size_t>(flight.record_capacity);
  film::SplatRecords records;
  records.words = flight.host_records + batch * capacity * record_words(parts_);
  records.capacity = capacity;
  records.count = static_cast<std::size_t>(flight.host_record_counts[batch]);
  records.paths = flight.batch_paths();
  film.add_splatting_paths(jobs * samples);
  if (parts_.techniques) film::SplatFolder::fold_techniques(records, film);
  for (const std::size_t path : folder_.fold(records, film))
    count_nonfinite(flight.launch, first_job + path / samples, 1, static_cast<int>(path % samples), 1);
}

void Launcher::collect(film::Film& film) {
  Flight flight = std::move(flights_.front());
  flights_.pop_front();
  if (flight.batches > 0) film.use_splats();
  for (std::size_t batch = 0; batch < flight.batches; ++batch) fold_batch(flight, batch, film);
  if (flight.batches == 0) fold_sums(flight, 0, flight.host_sums.size(), film);
  unmap(flight);
  counts_.paths += static_cast<std::uint64_t>(flight.launch.jobs) *
                   static_cast<std::uint64_t>(flight.launch.block_samples);
  for (std::size_t item = 0; item < flight.items; ++item) {
    counts_.rays += flight.host_counters[item * counters_per_item];
    counts_.shadow_rays += flight.host_counters[item * counters_per_item + 1];
  }
  adapt(flight);
  spare_.push_back(std::move(flight.buffers));
}

void Launcher::adapt(const Flight& flight) {
  const cl_ulong begin = flight.kernel_done.getProfilingInfo<CL_PROFILING_COMMAND_START>();
  const cl_ulong end = flight.kernel_done.getProfilingInfo<CL_PROFILING_COMMAND_END>();
  const double seconds = static_cast<double>(end - begin) * 1e-9;
  if (seconds <= 0) return;
  const double rate = static_cast<double>(flight.launch.jobs * flight.launch.block_samples) / seconds;
  // Grow by no more than 4 times at once: a first launch may have been unrepresentative.
  paths_per_second_ = paths_per_second_ > 0 ? std::min(rate, 4 * paths_per_second_) : rate;
}

} // namespace phlux::render
