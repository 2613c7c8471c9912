// What the dispatch loop shares its work among: a device of this process, or another process.
#pragma once

#include <cstddef>
#include <string>

#include "errors.h"
#include "render/launch_plan.h"
#include "render/launch_result.h"
#include "settings/settings.h"

namespace phlux::render {

/// A launch takes more memory than there is.
struct MemoryShort : DeviceError {
  using DeviceError::DeviceError;
};

/// A processor will not be there again.
struct ProcessorLost : DeviceError {
  using DeviceError::DeviceError;
};

/// Runs launches, in their order. After any exception, abandon() makes it usable again.
class Processor {
public:
  Processor() = default;
  virtual ~Processor() = default;
  Processor(const Processor&) = delete;
  Processor& operator=(const Processor&) = delete;

  /// Sets what may differ between the renders of a scene: the seed and the duration of a launch.
  virtual void begin(const settings::Settings& settings) = 0;
  /// Whether it can take launches by now; may wait a little. @throws ProcessorLost
  [[nodiscard]] virtual bool is_ready() { return true; }
  /// Determines the length of its next launch.
  [[nodiscard]] virtual Pace pace() const = 0;
  /// @throws DeviceError, cl::Error, std::bad_alloc, as settle()
  virtual void enqueue(const Launch& launch) = 0;
  [[nodiscard]] virtual std::size_t in_flight() const = 0;
  [[nodiscard]] virtual std::size_t most_in_flight() const = 0;
  /// Waits for the oldest launch. @throws MemoryShort when its results do not fit the device's memory
  virtual void settle() = 0;
  /// Of the oldest launch, after settle(); valid until release().
  [[nodiscard]] virtual LaunchResult& result() = 0;
  /// Forgets the oldest launch.
  virtual void release() noexcept = 0;
  /// The result in memory of its own, and release(). @throws std::bad_alloc
  [[nodiscard]] virtual LaunchResult detach() = 0;
  /// Drops the launches in flight.
  virtual void abandon() noexcept = 0;
  /// Later launches take less memory. False if they cannot.
  [[nodiscard]] virtual bool shrink() = 0;
  /// For messages, such as "OpenCL device P:D (NAME)".
  [[nodiscard]] virtual std::string name() const = 0;
};

} // namespace phlux::render
