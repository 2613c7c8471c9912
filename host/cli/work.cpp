#include "cli/work.h"

#include <exception>
#include <new>

#include <spdlog/spdlog.h>

#include "checkpoint/sameness.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "errors.h"
#include "scene/digest.h"
#include "scene_file/load.h"

namespace phlux::cli {
namespace {

void work_on(const RenderOptions& options, cluster::Group& group) {
  scene::Scene scene =
      scene_file::load(options.scene_file, options.definitions, options.size, lobes::Library(options.lobes));
  const render::Settings settings =
      settings::settings_of(options, scene.defaults, defaults_of(options, group));
  const std::string digest = checkpoint::digest_with_strategy(scene::digest(scene), settings);
  crop(scene, options); // whose digest is that of the whole image
  if (!cluster::wait_for_kernels(group)) return;
  const render::Renderer renderer(scene, settings, {});
  cluster::serve(group, *renderer.processors().front(), settings, digest);
}

} // namespace

render::Settings defaults_of(const RenderOptions& options, const cluster::Group& group) {
  render::Settings defaults = defaults_of(options);
  if (group.size() > 1) defaults.devices = {cluster::own_device(group, options.devices)};
  return defaults;
}

int work(cluster::Group& group, const RenderOptions& given) {
  spdlog::set_level(spdlog::level::off);
  const InterruptGuard interrupt;
  const std::optional<settings::Choices> choices = cluster::choices_of_render(group);
  if (!choices) return 0;
  RenderOptions options = given;
  static_cast<settings::Choices&>(options) = *choices;
  try {
    work_on(options, group);
  } catch (const std::bad_alloc&) {
    cluster::decline(group, "out of memory");
  } catch (const std::exception& error) {
    cluster::decline(group, error.what());
  }
  return 0;
}

} // namespace phlux::cli
