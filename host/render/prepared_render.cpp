#include "render/prepared_render.h"

#include "render/schedule.h"

namespace phlux::render {

device::BuiltProgram Programs::program(const Parts& parts) {
  constexpr std::size_t most = 16;
  std::map<std::string, std::string> key = parts.defines();
  key["file"] = parts.file();
  if (const auto found = kept_.find(key); found != kept_.end()) return found->second;
  if (kept_.size() == most) kept_.clear();
  return kept_.emplace(key, device::build(device_, files_, parts.source(parts.file()))).first->second;
}

PreparedRender::PreparedRender(Programs& programs, const scene::Scene& scene, const Settings& settings)
    : settings_(settings), device_(programs.device()), width_(scene.camera.width),
      height_(scene.camera.height),
      host_(prepare(scene, settings.traversal, lanes_for(device_.info, settings), settings.double_precision,
                    wants_light_tree(settings))),
      parts_(find_parts(scene, host_.geometry, host_.lights, settings, lanes_for(device_.info, settings))),
      program_(programs.program(parts_)) {}

PreparedRender::Image PreparedRender::image(std::uint64_t seed, int samples_per_pixel) const {
  Image image{film::Film(width_, height_)};
  image.film.set_unit(host_.lights.unit);
  if (settings_.clamp) image.film.set_clamp(*settings_.clamp);
  if (settings_.techniques) image.film.use_techniques();
  Settings settings = settings_;
  settings.seed = seed;
  Launcher launcher(device_, program_, host_, parts_, settings);
  Schedule schedule(static_cast<std::int64_t>(image.film.pixels().size()), samples_per_pixel);
  while (const auto launch = schedule.next(
             [&](std::int64_t left, int samples) { return launcher.wanted_jobs(left, samples); })) {
    launcher.enqueue(*launch);
    launcher.settle();
    launcher.collect(image.film);
  }
  image.nonfinite = launcher.take_counts().nonfinite;
  return image;
}

} // namespace phlux::render
