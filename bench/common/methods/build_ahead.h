// Kernels of many scenes and methods, built on every processor before anything is timed: drivers build in one
// thread of a process.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bench/common/methods/scene_bench.h"

namespace phlux::bench {

/// Runs each job in one of as many child processes as there are processors, and waits for them all. A job
/// says how many programs it built; the sum is returned, less those of children that failed, whose jobs are
/// simply not done. Only for a process that has not used OpenCL yet: its drivers' threads do not live on in a
/// child.
[[nodiscard]] std::size_t run_in_children(const std::vector<std::function<std::size_t()>>& jobs);

/// Builds, in children, the programs of every scene and method or finds them in the cache; returns how many
/// were built. A method that refuses a scene has none.
[[nodiscard]] std::size_t build_programs(const std::vector<std::function<scene::Scene()>>& scenes,
                                         const std::vector<Method>& methods,
                                         const SceneBenchSettings& settings);

} // namespace phlux::bench
