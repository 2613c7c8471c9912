// One scene by several methods: a pilot, a reference by the method that converges best, then rounds in which
// the methods take turns.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/common/methods/method.h"
#include "bench/common/methods/reference.h"
#include "clock.h"

namespace phlux::bench {

struct SceneBenchSettings {
  std::vector<std::string> devices;
  int lanes = 0;
  std::filesystem::path kernel_dir;
  std::uint64_t seed = 1;
  double seconds = 120;  ///< for all of the scene; building kernels counts
  int least_rounds = 10; ///< seeds of each method: fewer than most_rounds only where time is short
  int most_rounds = 10;
  int trial_renders = 6;             ///< of each method; fewer do not tell who has rare large samples
  std::function<bool()> interrupted; ///< may be empty
  std::function<void(const std::string& what)> report; ///< may be empty; called often
};

/// How `method` is rendered: the scene's depths, these settings' devices and seed.
[[nodiscard]] render::Settings render_settings(const Method& method, const scene::Scene& scene,
                                               const SceneBenchSettings& settings);

/// The method on its first few renders.
struct Trial {
  Method method;
  std::string refusal{}; ///< why it cannot render the scene; the rest is empty then
  double variance = 0;   ///< per sample, relative to a provisional reference; an upper estimate
  double seconds_per_sample = 0;
  std::vector<ImageEstimate> images{};
};

/// The image and its error at one of the doubling times, over the rounds.
struct ConvergencePoint {
  double seconds = 0, samples_per_pixel = 0;            ///< medians
  double relmse = 0, relmse_least = 0, relmse_most = 0; ///< mean and range
  int rounds = 0;                                       ///< that have an image of that time
};

enum class Verdict { sound, suspect_variance, biased, refused };
[[nodiscard]] const char* word_of(Verdict verdict);

struct MethodResult {
  Method method;
  Verdict verdict = Verdict::sound;
  std::string reason{}; ///< of the verdict
  Figure variance{};    ///< per sample
  double top_share = 0;
  Figure mean{};              ///< of the image
  double mean_bias_sigma = 0; ///< (mean - reference's) / standard error of the difference
  double seconds_per_sample = 0, seconds_per_sample_least = 0, seconds_per_sample_most = 0;
  double processor_seconds_per_sample = 0;     ///< of all threads; the median
  std::vector<ConvergencePoint> convergence{}; ///< the last one is of the whole renders
  int rounds = 0;
  ImageEstimate first_image{}; ///< of the first round, for looking at
};

class SceneBench {
public:
  SceneBench(const scene::Scene& scene, const SceneBenchSettings& settings);

  /// @throws Interrupted, DeviceError
  void try_methods(const std::vector<Method>& methods);
  [[nodiscard]] const std::vector<Trial>& trials() const { return trials_; }
  /// By the trial of the least variance times seconds, of those whose mean is known to be right.
  /// @throws Interrupted, DeviceError, SceneError where no method can render the scene
  [[nodiscard]] ReferenceImage reference() const;
  /// Each method that was tried, in turns. @throws Interrupted, DeviceError
  [[nodiscard]] std::vector<MethodResult> measure(const ReferenceImage& reference) const;

private:
  [[nodiscard]] render::Settings settings_for(const Method& method) const;
  [[nodiscard]] Trial try_method(const Method& method, double seconds) const;
  void rate_trials();
  [[nodiscard]] const Trial* best_trial() const;
  [[nodiscard]] double seconds_left() const;
  void say(const std::string& what) const;

  const scene::Scene& scene_;
  const SceneBenchSettings& settings_;
  Clock::time_point begin_;
  std::vector<Trial> trials_;
  double overhead_ = 0; ///< seconds of a round of one method beyond those asked for
};

} // namespace phlux::bench
