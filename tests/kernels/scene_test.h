// Runs kernels with the arguments SCENE_PARAMETERS, then those of the test.
#pragma once

#include <string>

#include "device_test.h"
#include "render/device_scene.h"
#include "render/parts.h"

namespace device_test {

class SceneProgram {
public:
  /// The kernels of tests/kernels/FILE with the parts of this scene.
  SceneProgram(Variant variant, const std::string& file, const phlux::scene::Scene& scene,
               const std::string& strategy = "exact",
               phlux::render::Traversal traversal = phlux::render::Traversal::brute_force)
      : SceneProgram(variant, file, scene, settings_of(strategy, traversal)) {}

  SceneProgram(Variant variant, const std::string& file, const phlux::scene::Scene& scene,
               const phlux::render::Settings& settings)
      : host_(phlux::render::prepare(scene, settings, variant.width)),
        parts_(parts_of(scene, host_, settings, variant.width)), device_(test_device(), host_, parts_),
        program_(&program_with(file, variant, parts_.source(""))) {}

  template<typename... Arguments>
  void run(const char* name, std::size_t count, const Arguments&... arguments) const {
    phlux::device::Kernel kernel = program_->kernel(name);
    device_.bind(kernel);
    program_->run_bound(std::move(kernel), count, arguments...);
  }

  [[nodiscard]] const phlux::render::HostScene& host() const { return host_; }

private:
  // A light tree also for fewer lights than in renders.
  static phlux::render::Parts parts_of(const phlux::scene::Scene& scene, const phlux::render::HostScene& host,
                                       const phlux::render::Settings& settings, int lanes) {
    phlux::render::Parts parts =
        phlux::render::find_parts(scene, *host.geometry, host.lights, settings, lanes);
    parts.light_tree = !host.lights.nodes.empty() && parts.connect != phlux::render::Connect::none;
    return parts;
  }

  static phlux::render::Settings settings_of(const std::string& strategy,
                                             phlux::render::Traversal traversal) {
    phlux::render::Settings settings;
    settings.strategy = strategy;
    settings.traversal = traversal;
    return settings;
  }

  phlux::render::HostScene host_;
  phlux::render::Parts parts_;
  phlux::render::DeviceScene device_;
  const Program* program_;
};

} // namespace device_test
