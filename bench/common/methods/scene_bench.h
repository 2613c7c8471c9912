// Measures several methods on one scene: trial renders, a reference by the method with the least time to unit
// variance, then rounds in which the methods alternate.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/common/methods/known_bias.h"
#include "bench/common/methods/method_result.h"
#include "clock.h"

namespace phlux::bench {

struct SceneBenchSettings {
  std::vector<std::string> devices;
  int lanes = 0;
  std::filesystem::path kernel_dir;
  std::uint64_t seed = 1;
  double seconds = 120; ///< for the whole scene, from the constructor of SceneBench on
  int least_rounds = 5; ///< even if they take longer than `seconds`
  int most_rounds = 10;
  std::function<bool()> interrupted; ///< may be empty
  /// Receives the current step and the seconds left; may be empty.
  std::function<void(const std::string& what, double seconds_left)> report;
  /// Receives what the user must know before it happens; may be empty.
  std::function<void(const std::string& text)> notice;
};

/// Settings of render() for `method`: depths of the scene, devices and seed of `settings`.
[[nodiscard]] render::Settings render_settings(const Method& method, const scene::Scene& scene,
                                               const SceneBenchSettings& settings);

/// Estimates from the trial renders of a method.
struct Trial {
  Method method;
  std::string refusal{}; ///< why it cannot render the scene; then the rest is empty
  double variance = 0;   ///< per sample, relative to a provisional reference, plus 3 standard errors
  double seconds_per_sample = 0;
  double least_seconds = 0; ///< for one sample per pixel
  std::vector<ImageEstimate> images{};
  std::unique_ptr<MethodRenderer> renderer{}; ///< may be empty between renders
};

class SceneBench {
public:
  /// @throws DeviceError
  SceneBench(const scene::Scene& scene, const SceneBenchSettings& settings);

  /// Uses at most 15% of the time. @throws Interrupted, DeviceError
  void try_methods(const std::vector<Method>& methods);
  [[nodiscard]] const std::vector<Trial>& trials() const { return trials_; }
  /// Rendered by the method of the trial with the least variance x seconds among those without a known bias.
  /// @throws Interrupted, DeviceError, SceneError if no method can render the scene
  [[nodiscard]] ReferenceImage reference();
  /// Measures every method of the trials in the time that is left. Raises the variance of the reference if
  /// the rounds of its method show a larger one. @throws Interrupted, DeviceError
  [[nodiscard]] std::vector<MethodResult> measure(ReferenceImage& reference);

private:
  [[nodiscard]] Trial try_method(const Method& method, double seconds, int renders) const;
  void rate_trials();
  [[nodiscard]] Trial* best_trial();
  [[nodiscard]] MethodRenderer& renderer_of(Trial& trial) const;
  void release(Trial& trial) const;
  [[nodiscard]] std::vector<Trial*> accepted();
  [[nodiscard]] std::vector<MethodRenders> run_rounds(const std::vector<Trial*>& methods,
                                                      const ReferenceImage& reference);
  [[nodiscard]] double seconds_left() const;
  void report_step(const std::string& what, double seconds_left) const;

  const scene::Scene& scene_;
  const SceneBenchSettings& settings_;
  KnownBias known_bias_;
  Clock::time_point begin_;
  bool keep_renderers_ = true;
  std::vector<Trial> trials_;
};

} // namespace phlux::bench
