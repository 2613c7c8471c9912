// render::Renderer on the device under test, for many renders of small images.
#pragma once

#include <filesystem>
#include <map>
#include <memory>

#include "render/programs.h"
#include "render/render.h"

namespace phlux::test {

/// Programs are kept for all renders of a test program: variants of a scene have the same kernels.
class PreparedRender {
public:
  /// @throws as render::Renderer
  PreparedRender(const scene::Scene& scene, const render::Settings& settings)
      : settings_(settings), width_(scene.camera.width), height_(scene.camera.height),
        renderer_(std::make_unique<render::Renderer>(programs_by(settings), scene, settings)) {}

  struct Image {
    film::Film film;
    std::uint64_t nonfinite = 0;
  };
  [[nodiscard]] Image image(std::uint64_t seed, int samples_per_pixel) const {
    Image image{film::Film(width_, height_)};
    render::Settings settings = settings_;
    settings.seed = seed;
    settings.samples_per_pixel = samples_per_pixel;
    image.nonfinite = renderer_->render(settings, image.film, {}).nonfinite;
    return image;
  }

private:
  static render::Programs& programs_by(const render::Settings& settings) {
    static std::map<std::filesystem::path, render::Programs> kept;
    const auto found = kept.find(settings.kernel_dir);
    if (found != kept.end()) return found->second;
    return kept
        .try_emplace(settings.kernel_dir, device::open_devices(settings.devices).front(),
                     sources::KernelFiles(settings.kernel_dir))
        .first->second;
  }

  render::Settings settings_;
  int width_, height_;
  std::unique_ptr<render::Renderer> renderer_;
};

} // namespace phlux::test
