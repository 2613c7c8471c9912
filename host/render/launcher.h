// Runs the launches of one device and adds their results to the film.
#pragma once

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "device/kernel.h"
#include "errors.h"
#include "film/film.h"
#include "film/splat_records.h"
#include "render/device_scene.h"
#include "render/launch_plan.h"

namespace phlux::render {

/// A launch takes more memory than there is.
struct MemoryShort : DeviceError {
  using DeviceError::DeviceError;
};

class Launcher {
public:
  /// @throws DeviceError
  Launcher(const device::Device& device, const device::BuiltProgram& program, const HostScene& scene,
           const Parts& parts, const Settings& settings);
  ~Launcher() { abandon(); }
  Launcher(const Launcher&) = delete;
  Launcher& operator=(const Launcher&) = delete;

  /// Sets what may differ between the renders of a scene: the seed and the duration of a launch.
  void begin(const Settings& settings);

  /// An empty launch. Drivers defer work to a kernel's first launch; PoCL compiles most of the kernel then.
  void warm_up();

  /// The number of jobs of the next launch, to last about Settings::launch_seconds, when `left` are left.
  [[nodiscard]] std::int64_t wanted_jobs(std::int64_t left, int block_samples) const {
    return planner_.wanted_jobs(left, block_samples);
  }
  /// @throws DeviceError, cl::Error, std::bad_alloc, as settle(); abandon() makes the launcher usable again
  void enqueue(const Launch& launch);
  [[nodiscard]] std::size_t in_flight() const { return flights_.size(); }
  /// One launch runs while the results of the previous one are added to the film, if there is memory.
  [[nodiscard]] std::size_t most_in_flight() const { return memory_is_short_ ? 1 : 2; }
  /// Waits for the oldest launch; repeats it with larger buffers until its results fit. @throws MemoryShort
  /// when they do not fit the device's memory
  void settle();
  /// Adds the oldest launch, after settle(), to the film. If this throws, the film is no longer valid.
  void collect(film::Film& film);
  /// Counts of the launches collected since the last call.
  [[nodiscard]] Counts take_counts() { return std::exchange(counts_, {}); }
  /// Drops the launches in flight and all their buffers, and unmaps these; waits until nothing writes into
  /// this object's memory.
  void abandon() noexcept;
  /// Later launches take less memory. False if they cannot.
  [[nodiscard]] bool shrink();
  [[nodiscard]] const device::DeviceInfo& device() const { return device_.info; }

private:
  // Buffers of a launch. They are reused, as allocation takes longer than the copies.
  struct Buffer {
    cl::Buffer memory;
    std::size_t bytes = 0;
  };
  struct Buffers {
    Buffer sums, counters, records, record_counts, scratch;
  };
  struct Flight {
    Launch launch;
    LaunchPlan plan;
    Buffers buffers;
    cl::Event kernel_done;
    std::vector<cl::Event> copies; // to the members below
    std::vector<film::BlockSum> host_sums;
    std::vector<cl_uint> host_counters;
    std::vector<cl_int> host_record_counts;
    float* host_records = nullptr; // mapped
  };
  void start(Flight& flight);
  void reserve(Buffer& buffer, std::size_t bytes, const char* what) const;
  void read_back(Flight& flight);
  static void wait(const Flight& flight);
  void unmap(Flight& flight);
  [[nodiscard]] bool finish() const noexcept;
  void fold_sums(const Flight& flight, std::size_t first_job, std::size_t jobs, film::Film& film);
  void fold_batch(const Flight& flight, std::size_t batch, film::Film& film);
  void count_nonfinite(const Launch& launch, std::size_t job, std::uint64_t count, int sample, int samples);

  device::Device device_;
  DeviceScene scene_;
  Parts parts_;
  device::Kernel kernel_;
  Planner planner_;
  std::int64_t pixels_;
  std::int64_t first_sample_ = 0; // of the render
  std::deque<Flight> flights_;
  std::vector<Buffers> spare_;
  film::SplatFolder folder_;
  Counts counts_;
  bool memory_is_short_ = false;
  std::int64_t last_jobs_ = 0; // of the last launch
};

} // namespace phlux::render
