// The result of one method on one scene: variance, bias and time from its renders, and a verdict.
#pragma once

#include <span>
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
/// infinite, its value is a lower bound. biased: the image differs from the reference by more than all
/// variances explain, or the method is known to be biased. undecided: too few samples to tell. refused: the
/// renderer cannot render the scene.
enum class Verdict { sound, suspect_variance, biased, undecided, refused };

/// "sound", "suspect", "biased", "undecided", "refused".
[[nodiscard]] const char* word_of(Verdict verdict);

/// Variance and times per sample in one round.
struct RoundCost {
  double variance = 0, seconds = 0, processor_seconds = 0;
};

/// Seconds per sample over the rounds.
struct SampleTime {
  double median = 0, least = 0, most = 0;
};

struct MethodResult {
  Method method;
  Verdict verdict = Verdict::sound;
  std::string reason{}; ///< of the verdict
  Estimate variance{};  ///< per sample
  double top_share = 0;
  Estimate mean{};                ///< of the image
  double mean_bias_sigma = 0;     ///< (mean - mean of the reference) / standard error of the difference
  SampleTime wall{}, processor{}; ///< processor time over all threads
  /// How many times as long a measurement would have to be to decide; of undecided and suspect methods.
  double times_longer = 0;
  std::vector<RoundCost> rounds{};
  std::vector<ConvergencePoint> convergence{}; ///< the last one is for the complete renders
  ImageEstimate first_image{};                 ///< of the first round

  /// Sets the verdict and its reason. `error_ratio`: the error that prevents another verdict / the largest
  /// one that would allow it. Errors decrease with the square root of the time.
  void decide(Verdict v, const std::string& why, double error_ratio = 2);
};

/// Collects the renders of one method on one scene.
class MethodRenders {
public:
  /// `render` must have an image with one sample per pixel.
  void add(TimedRender render, const Reference& reference);

  /// Relative variance per sample. Requires two renders or more.
  [[nodiscard]] Estimate variance(const Reference& reference) const;

  /// Requires two renders or more. `known_bias`: why the method is known to be biased, or empty.
  [[nodiscard]] MethodResult result(const Method& method, const ReferenceImage& reference,
                                    const std::string& known_bias) const;

private:
  struct TimedError {
    std::size_t time = 0; ///< index of a doubling time; `doublings` for a complete render
    double seconds = 0, samples_per_pixel = 0, relmse = 0;
  };
  [[nodiscard]] static TimedError error_of(const Snapshot& snapshot, const Reference& reference);
  [[nodiscard]] std::vector<ConvergencePoint> convergence() const;
  // `variances` are those of the rounds.
  void judge(MethodResult& result, const ReferenceImage& reference, std::span<const double> variances) const;
  [[nodiscard]] bool suspect(MethodResult& result, const ReferenceImage& reference,
                             std::span<const double> variances) const;

  std::vector<ImageEstimate> images_, one_sample_images_;
  std::vector<RoundCost> costs_; // without variances, which depend on all images
  std::vector<TimedError> errors_;
};

} // namespace phlux::bench
