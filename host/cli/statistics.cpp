#include "cli/statistics.h"

namespace phlux::cli {

nlohmann::ordered_json statistics_json(const render::Statistics& statistics, const files::RenderInfo& info,
                                       const film::Film& film) {
  return {{"version", info.version},
          {"scene", info.scene},
          {"integrator", info.integrator},
          {"strategy", info.strategy},
          {"seed", info.seed},
          {"device", statistics.device},
          {"driver", statistics.driver},
          {"lanes", statistics.lanes},
          {"traversal", statistics.traversal},
          {"parts", statistics.parts},
          {"width", film.width()},
          {"height", film.height()},
          {"samples_per_pixel", film.samples_per_pixel()},
          {"paths", statistics.paths},
          {"rays", statistics.rays},
          {"shadow_rays", statistics.shadow_rays},
          {"nonfinite", statistics.nonfinite},
          {"seconds",
           {{"setup", statistics.seconds_setup},
            {"build_kernels", statistics.seconds_build_kernels},
            {"render", statistics.seconds_render}}},
          {"kernel_cache", statistics.kernels_from_cache ? "hit" : "miss"},
          {"variance", film.has_variance() ? nlohmann::ordered_json(film.relative_variance()) : nullptr},
          {"relative_standard_error", film.relative_standard_error()},
          {"interrupted", statistics.interrupted}};
}

} // namespace phlux::cli
