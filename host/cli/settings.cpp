#include "cli/settings.h"

namespace phlux::cli {

settings::Settings settings_of(const RenderOptions& options, const scene::RenderDefaults& defaults) {
  settings::Settings settings;
  settings.techniques = !options.contributions.empty();
  settings.devices = options.devices;
  settings.kernel_dir = options.kernel_dir;
  return settings::settings_of(options, defaults, settings);
}

} // namespace phlux::cli
