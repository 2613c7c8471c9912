// The part of a render that each process of a cluster does.
#pragma once

#include "cli/options.h"
#include "cluster/team.h"
#include "render/render.h"

namespace phlux::cli {

/// Whether process 0 reports for this one: what it cannot read here, it tells process 0 in work().
[[nodiscard]] inline bool is_worker() {
  return cluster::started().rank > 0;
}

/// The settings that options other than those of settings::all() give. Of several processes, each has one
/// device.
[[nodiscard]] render::Settings defaults_of(const RenderOptions& options, const cluster::Group& group);

/// Runs launches for process 0 until the render ends; for all other processes. Process 0 reports failures and
/// writes all files. Returns 0. Signals do not end the process: process 0 ends the render.
[[nodiscard]] int work(cluster::Group& group, const RenderOptions& given);

} // namespace phlux::cli
