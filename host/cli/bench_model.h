// Options of `phlux bench sampling` that name a reflectance model other than phong: --lobe, --model and
// --set.
#pragma once

#include <memory>

#include "bench/sampling/sampling.h"
#include "cli/grammar.h"

namespace phlux::cli {

/// Sets the material of the options.
void add_bench_model(CLI::App& app, const std::shared_ptr<bench::SamplingOptions>& options);

} // namespace phlux::cli
