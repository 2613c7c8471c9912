// Renders a scene by settings onto a film.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "errors.h"
#include "film/film.h"
#include "render/statistics.h"
#include "scene/scene.h"
#include "settings/settings.h"
#include "tables/host_scene.h"

namespace phlux::render {

using settings::Connect;
using settings::connect_names;
using settings::connect_of;
using settings::Integrator;
using settings::LightSelection;
using settings::Roulette;
using settings::roulette_names;
using settings::Sampler;
using settings::Settings;
using settings::strategy_names;
using settings::Traversal;
using settings::Weights;
using settings::weights_names;

struct Events {
  std::function<void()> building_kernels;          ///< called when building takes longer than 200 ms
  std::function<void(const std::string&)> warning; ///< for valid settings that may surprise with the scene
  /// Called between launches, about every 50 ms; false ends the render, and the film keeps its samples.
  std::function<bool(const Progress&)> progress;
};

/// All devices have failed. The film has the samples of `statistics`, from which the render resumes.
struct DevicesFailed : DeviceError {
  DevicesFailed(const std::string& line, Statistics so_far)
      : DeviceError(line), statistics(std::move(so_far)) {}
  Statistics statistics;
};

class Processor; // render/processor.h
class Programs;  // render/programs.h

/// A scene that is ready to be rendered: its tables and its program on every device. Renders it several times
/// without building and copying these again.
class Renderer {
public:
  /// `scene` and `settings` are only used here. `known`: of the same scene, with any camera. @throws
  /// UsageError for settings that cannot work, SceneError for a scene that cannot be rendered, DeviceError
  Renderer(const scene::Scene& scene, const Settings& settings, const Events& events,
           tables::KnownGeometry* known = nullptr);
  /// On the device of `programs`, with its programs; the devices and the kernel folder of `settings` are
  /// ignored. @throws as the other constructor
  Renderer(Programs& programs, const scene::Scene& scene, const Settings& settings);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Adds samples to `film`, which has the camera's width and height. Seed, samples, limits of time and
  /// error, launch_seconds and clamp are those of `settings`; everything else must be as in the
  /// constructor's. To resume an earlier render, `film` is the earlier one's and `from` its state; samples,
  /// seconds and counts then include the earlier ones. The film is the same, bit for bit, as without
  /// the interruption, and on any number of like devices. The set-up times in the result are those of the
  /// constructor. `others` take part in the work.
  /// @throws UsageError, SceneError for a film of another version, DevicesFailed
  [[nodiscard]] Statistics render(const Settings& settings, film::Film& film, const Events& events,
                                  const RenderState& from = {}, const std::vector<Processor*>& others = {});

  /// The devices.
  [[nodiscard]] std::vector<Processor*> processors() const;

private:
  struct Ready;
  std::unique_ptr<Ready> ready_;
};

/// Renderer::render() for one render. If all devices fail, it continues with new contexts of them for as long
/// as that helps. @throws as Renderer and its render()
[[nodiscard]] Statistics render(const scene::Scene& scene, const Settings& settings, film::Film& film,
                                const Events& events, const RenderState& from = {},
                                const std::vector<Processor*>& others = {},
                                tables::KnownGeometry* known = nullptr);

} // namespace phlux::render
