// Measures several methods on one scene: trial renders, a reference by the method with the least time to unit
// variance, then rounds in which the methods alternate.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/common/methods/method_result.h"
#include "clock.h"

namespace phlux::bench {

struct SceneBenchSettings {
  std::vector<std::string> devices;
  int lanes = 0;
  std::filesystem::path kernel_dir;
  std::uint64_t seed = 1;
  double seconds = 120;  ///< for the whole scene, building kernels included
  int least_rounds = 10; ///< even if that takes longer than `seconds`
  int most_rounds = 10;
  int trial_renders = 6;             ///< per method; fewer would not reveal rare large samples
  std::function<bool()> interrupted; ///< may be empty
  std::function<void(const std::string& what)> report; ///< receives the current step; may be empty
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
  std::vector<ImageEstimate> images{};
};

class SceneBench {
public:
  SceneBench(const scene::Scene& scene, const SceneBenchSettings& settings);

  /// @throws Interrupted, DeviceError
  void try_methods(const std::vector<Method>& methods);
  [[nodiscard]] const std::vector<Trial>& trials() const { return trials_; }
  /// Rendered by the method of the trial with the least variance x seconds among those without a known bias.
  /// @throws Interrupted, DeviceError, SceneError if no method can render the scene
  [[nodiscard]] ReferenceImage reference() const;
  /// Measures every method of the trials. @throws Interrupted, DeviceError
  [[nodiscard]] std::vector<MethodResult> measure(const ReferenceImage& reference) const;

private:
  [[nodiscard]] render::Settings settings_for(const Method& method) const;
  [[nodiscard]] Trial try_method(const Method& method, double seconds) const;
  void rate_trials();
  [[nodiscard]] const Trial* best_trial() const;
  [[nodiscard]] double seconds_left() const;
  void report_step(const std::string& what) const;

  const scene::Scene& scene_;
  const SceneBenchSettings& settings_;
  Clock::time_point begin_;
  std::vector<Trial> trials_;
  double overhead_ = 0; ///< seconds that one method takes per round beyond the requested ones
};

} // namespace phlux::bench
