// What `--stats` writes.
#pragma once

#include <nlohmann/json.hpp>

#include "cli/diagnosis.h"
#include "files/image.h"
#include "film/film.h"
#include "render/render.h"

namespace phlux::cli {

/// All keys of CONTRACT.md, the settings of the image and its samples, and version, scene, lanes, traversal,
/// parts (what the kernel holds code for), interrupted. `variance` and `relative_standard_error` are the
/// film's; an infinite one becomes null.
[[nodiscard]] nlohmann::ordered_json statistics_json(const render::Statistics& statistics,
                                                     const render::Settings& settings,
                                                     const files::RenderInfo& info, const film::Film& film,
                                                     const Diagnosis& diagnosis);

} // namespace phlux::cli
