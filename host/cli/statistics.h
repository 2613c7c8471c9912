// The JSON of --stats.
#pragma once

#include <nlohmann/json.hpp>

#include "cli/diagnosis.h"
#include "files/image.h"
#include "film/film.h"
#include "render/render.h"

namespace phlux::cli {

/// The settings of the image and of its samples, and the statistics of the render, of the film and of its
/// error estimate. `parts` are those that the kernel has code for. Infinite values, and what a
/// signal has left out of the diagnosis, become null.
[[nodiscard]] nlohmann::ordered_json statistics_json(const render::Statistics& statistics,
                                                     const render::Settings& settings,
                                                     const files::RenderInfo& info, const film::Film& film,
                                                     const Diagnosis& diagnosis);

} // namespace phlux::cli
