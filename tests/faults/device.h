// Makes calls of OpenCL fail: of a program that links this library before the loader, or in which it is
// preloaded. Then the environment variable PHLUX_DEVICE_FAULT="CALL FIRST COUNT CODE [QUEUE]" plans a fault.
#pragma once

#include <string>

namespace faults {

/// Calls number `first` (from 0) to `first` + `count` - 1 of the function from now on return `code`; if
/// `queue` >= 0, only those calls count that are for the queue number `queue`, in the order of the queues'
/// first launches.
void plan_device_fault(const std::string& call, long first, long count, int code, int queue = -1);

/// Calls of the function since the last plan, and how many of them failed.
[[nodiscard]] long device_calls(const std::string& call);
[[nodiscard]] long device_faults();

/// Buffers that are mapped now.
[[nodiscard]] long mapped_buffers();

} // namespace faults
