#include "images/prepared_render.h"

#include <map>
#include <string>

#include "render/schedule.h"

namespace phlux::test {
namespace {

// Variants of a scene have the same kernels.
const device::BuiltProgram& program_for(const device::Device& device, const render::Parts& parts,
                                        const std::filesystem::path& kernels) {
  static std::map<std::map<std::string, std::string>, device::BuiltProgram> kept;
  constexpr std::size_t most = 16;
  std::map<std::string, std::string> key = parts.defines();
  key["file"] = parts.file();
  key["folder"] = kernels.string();
  if (const auto found = kept.find(key); found != kept.end()) return found->second;
  if (kept.size() == most) kept.clear();
  const sources::KernelFiles files(kernels);
  return kept.emplace(key, device::build(device, files, parts.source(parts.file()))).first->second;
}

} // namespace

PreparedRender::PreparedRender(const scene::Scene& scene, const render::Settings& settings)
    : scene_(scene), settings_(settings), device_(device::open_devices(settings.devices).front()),
      lanes_(render::lanes_for(device_.info, settings)),
      host_(render::prepare(scene, settings.traversal, lanes_, settings.double_precision,
                            render::wants_light_tree(settings))),
      parts_(render::find_parts(scene, host_.geometry, host_.lights, settings, lanes_)),
      program_(program_for(device_, parts_, settings.kernel_dir)) {}

PreparedRender::Image PreparedRender::image(std::uint64_t seed, int samples_per_pixel) const {
  Image image{film::Film(scene_.camera.width, scene_.camera.height)};
  image.film.set_unit(host_.lights.unit);
  if (settings_.clamp) image.film.set_clamp(*settings_.clamp);
  if (settings_.techniques) image.film.use_techniques();
  render::Settings settings = settings_;
  settings.seed = seed;
  render::Launcher launcher(device_, program_, host_, parts_, settings);
  render::Schedule schedule(static_cast<std::int64_t>(image.film.pixels().size()), samples_per_pixel);
  while (const auto launch = schedule.next(
             [&](std::int64_t left, int samples) { return launcher.wanted_jobs(left, samples); })) {
    launcher.enqueue(*launch);
    launcher.settle();
    launcher.collect(image.film);
  }
  image.nonfinite = launcher.take_counts().nonfinite;
  return image;
}

} // namespace phlux::test
