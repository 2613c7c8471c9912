#include "cli/settings.h"

#include "errors.h"
#include "render/parts.h"

namespace phlux::cli {

render::Settings settings_of(const RenderOptions& options, const scene::RenderDefaults& defaults) {
  render::Settings settings;
  settings.integrator = options.integrator.value_or(defaults.integrator);
  settings.strategy = options.strategy.value_or(settings.strategy);
  if (options.connect && settings.integrator != "path")
    throw UsageError("--connect is for path alone: " + settings.integrator +
                     " has its own ways to the lights");
  if (options.weights && settings.integrator != "bidir")
    throw UsageError("--weights is for bidir alone: " + settings.integrator +
                     " makes each path in one way: leave it out or use -i bidir");
  settings.connect = options.connect.value_or(settings.connect);
  settings.weights = options.weights.value_or(settings.weights);
  if (options.connections && !options.contributions.empty())
    throw UsageError("--connections: --contributions shows every connection: leave out one of the two");
  if (options.connections && settings.integrator != "bidir")
    throw UsageError("--connections is for bidir alone: " + settings.integrator +
                     " connects no vertices: leave it out or use -i bidir");
  settings.connections = options.connections.value_or(settings.connections);
  if (options.light_selection && !render::samples_lights(settings))
    throw UsageError(
        "--light-selection is for light samples, which neither -i light nor --connect none makes: "
        "leave it out");
  settings.light_selection = options.light_selection.value_or(settings.light_selection);
  settings.techniques = !options.contributions.empty();
  settings.ambient = options.ambient;
  settings.clamp = options.clamp;
  settings.samples_per_pixel = options.samples_per_pixel.value_or(defaults.samples_per_pixel);
  settings.time_limit = options.time_limit;
  settings.target_error = options.target_error;
  settings.max_depth = options.max_depth.value_or(defaults.max_depth);
  settings.rr_depth = options.rr_depth.value_or(defaults.rr_depth);
  settings.seed = options.seed.value_or(settings.seed);
  settings.first_sample = options.first_sample.value_or(settings.first_sample);
  settings.devices = options.devices;
  settings.lanes = options.lanes;
  settings.double_precision = options.double_precision.value_or(settings.double_precision);
  settings.traversal = options.traversal;
  settings.kernel_dir = options.kernel_dir;
  return settings;
}

} // namespace phlux::cli
