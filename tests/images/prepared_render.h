// render::PreparedRender on the device under test, by the tested kernels.
#pragma once

#include <filesystem>
#include <map>

#include "render/prepared_render.h"

namespace phlux::test {

/// Programs are kept for all renders of a test program: variants of a scene have the same kernels.
class PreparedRender : public render::PreparedRender {
public:
  /// @throws as render::render()
  PreparedRender(const scene::Scene& scene, const render::Settings& settings)
      : render::PreparedRender(programs_by(settings), scene, settings) {}

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
};

} // namespace phlux::test
