// The result of one method on one scene: variance, bias and time from its renders, and a verdict.
#pragma once

#include <string>
#include <vector>

#include "bench/common/methods/method.h"
#include "bench/common/methods/reference.h"
#include "bench/common/methods/timed_render.h"

namespace phlux::bench {

/// Intermediate images are taken at T / 32, T / 16, ..., T / 2 of renders that take time T.
inline constexpr std::size_t doublings = 5;

/// Error of the image after one of the doubling times, over the rounds.
struct ConvergencePoint {
  double seconds = 0, samples_per_pixel = 0;            ///< medians
  double relmse = 0, relmse_least = 0, relmse_most = 0; ///< mean and range
  int rounds = 0;                                       ///< that have an image for this time
};

/// sound: the variance is known and the mean agrees with the reference. suspect_variance: the variance may be
/// infinite, its value is a lower bound. biased: the image differs from the reference by more than the
/// variance explains, or the method is known to be biased. refused: the renderer cannot render the scene.
enum class Verdict { sound, suspect_variance, biased, refused };

/// "sound", "suspect", "biased", "refused".
[[nodiscard]] const char* word_of(Verdict verdict);

struct MethodResult {
  Method method;
  Verdict verdict = Verdict::sound;
  std::string reason{}; ///< of the verdict
  Estimate variance{};  ///< per sample
  double top_share = 0;
  Estimate mean{};            ///< of the image
  double mean_bias_sigma = 0; ///< (mean - mean of the reference) / standard error of the difference
  double seconds_per_sample = 0, seconds_per_sample_least = 0, seconds_per_sample_most = 0;
  double processor_seconds_per_sample = 0;     ///< over all threads; median
  std::vector<ConvergencePoint> convergence{}; ///< the last one is for the complete renders
  int rounds = 0;
  ImageEstimate first_image{}; ///< of the first round
};

/// Collects the renders of one method on one scene.
class MethodRenders {
public:
  /// `render` must have an image with one sample per pixel.
  void add(TimedRender render, const Reference& reference);

  /// Requires three renders or more. `known_bias`: why the method is known to be biased, or empty.
  [[nodiscard]] MethodResult result(const Method& method, const ReferenceImage& reference,
                                    const std::string& known_bias) const;

private:
  struct TimedError {
    std::size_t time = 0; ///< index of a doubling time; `doublings` for a complete render
    double seconds = 0, samples_per_pixel = 0, relmse = 0;
  };
  [[nodiscard]] static TimedError error_of(const Snapshot& snapshot, const Reference& reference);
  [[nodiscard]] std::vector<ConvergencePoint> convergence() const;
  void judge_mean(MethodResult& result, const ReferenceImage& reference, const std::string& known_bias) const;
  void judge_variance(MethodResult& result, const Reference& reference) const;

  std::vector<ImageEstimate> images_, one_sample_images_;
  std::vector<double> seconds_per_sample_, processor_seconds_per_sample_;
  std::vector<TimedError> errors_;
};

} // namespace phlux::bench
