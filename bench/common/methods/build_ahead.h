// Builds the kernels of many scenes and methods on all processors, before anything is timed. Child processes
// are used because drivers build in one thread of a process.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bench/common/methods/scene_bench.h"

namespace phlux::bench {

/// Distributes the jobs to one child process per processor, and waits for all. A job returns how many
/// programs it built; returns the sum over the children that did not fail. Only for a process that has not
/// used OpenCL yet: threads of the drivers do not exist in a child process.
[[nodiscard]] std::size_t run_in_children(const std::vector<std::function<std::size_t()>>& jobs);

/// Builds the programs of every scene and method that are not in the cache, in child processes; returns how
/// many were built. Skips methods that cannot render a scene.
[[nodiscard]] std::size_t build_programs(const std::vector<std::function<scene::Scene()>>& scenes,
                                         const std::vector<Method>& methods,
                                         const SceneBenchSettings& settings);

} // namespace phlux::bench
