#include "cli/commands.h"
#include "cli/info.h"
#include "files/json.h"
#include "scene_file/load.h"
#include "terminal.h"

namespace phlux::cli {

int info(const InfoOptions& options) {
  scene::Scene scene =
      scene_file::load(options.scene_file, options.definitions, options.size, lobes::Library(options.lobes));
  const render::Settings settings = settings::settings_of(options, scene.defaults, defaults_of(options));
  crop(scene, options);
  const nlohmann::ordered_json json = scene_json(options.scene_file.string(), scene, settings);
  say("{}", options.json ? files::json_text(json) : scene_text(json));
  return 0;
}

} // namespace phlux::cli
