// Runs the launches of one device.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "device/kernel.h"
#include "render/device_scene.h"
#include "render/processor.h"

namespace phlux::render {

/// "OpenCL device P:D (NAME)".
[[nodiscard]] std::string name_of(const device::DeviceInfo& device);

class Launcher final : public Processor {
public:
  /// @throws DeviceError
  Launcher(const device::Device& device, const device::BuiltProgram& program, const HostScene& scene,
           const Parts& parts, const Settings& settings);
  ~Launcher() override { abandon(); }

  void begin(const Settings& settings) override;

  /// An empty launch. Drivers defer work to a kernel's first launch; PoCL compiles most of the kernel then.
  void warm_up();

  [[nodiscard]] Pace pace() const override { return planner_.pace(); }
  void enqueue(const Launch& launch) override;
  [[nodiscard]] std::size_t in_flight() const override { return flights_.size(); }
  /// Two, if there is memory: the second begins when the first leaves cores idle, and runs while the results
  /// of the first are added to the film.
  [[nodiscard]] std::size_t most_in_flight() const override { return memory_is_short_ ? 1 : 2; }
  /// Repeats the launch with larger buffers until its results fit.
  void settle() override;
  [[nodiscard]] LaunchResult& result() override { return flights_.front().result; }
  void release() noexcept override;
  [[nodiscard]] LaunchResult detach() override;
  /// Drops also all their buffers, and unmaps these; waits until nothing writes into this object's memory.
  void abandon() noexcept override;
  [[nodiscard]] bool shrink() override;
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] const device::DeviceInfo& device() const { return device_.info; }

private:
  struct Buffer {
    cl::Buffer memory;
    std::size_t bytes = 0;
  };
  // The queue and the buffers of one launch in flight. Launches in two queues may overlap. Slots are reused,
  // because allocation takes longer than the copies.
  struct Slot {
    cl::CommandQueue queue;
    Buffer sums = {}, counters = {}, records = {}, record_counts = {}, scratch = {};
  };
  struct Flight {
    LaunchPlan plan;
    Slot slot;
    cl::Event kernel_done;
    std::vector<cl::Event> copies; // to the members below
    LaunchResult result;
    std::vector<cl_uint> host_counters;
    std::vector<cl_int> host_record_counts;
    float* host_records = nullptr; // mapped
  };
  [[nodiscard]] Slot spare_slot();
  void start(Flight& flight);
  void reserve(Buffer& buffer, std::size_t bytes, const char* what) const;
  void read_back(Flight& flight);
  static void wait(const Flight& flight);
  static void unmap(Flight& flight);
  [[nodiscard]] bool finish() const noexcept;

  device::Device device_;
  DeviceScene scene_;
  Parts parts_;
  device::Kernel kernel_;
  Planner planner_;
  std::int64_t first_sample_ = 0; // of the render
  std::deque<Flight> flights_;
  std::vector<Slot> spare_;
  bool memory_is_short_ = false;
  std::int64_t last_jobs_ = 0; // of the last launch
};

} // namespace phlux::render
