#include "bench/common/methods/scene_bench.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "bench/common/methods/timed_render.h"
#include "bench/common/moments.h"
#include "errors.h"

namespace phlux::bench {
namespace {

constexpr std::uint64_t first_trial_seed = 1'000'000;
constexpr double trial_share = 1.0 / 400; // of the scene's time, for one render of a trial
constexpr double reference_share = 0.15;  // of what trials left
constexpr double least_seconds = 0.03;    // of a render
constexpr std::size_t doublings = 5;      // times at which the error is looked at: T/32 to T
// A variance is suspect when repeats disagree on it by a quarter, or by a tenth while the largest thousandth
// of the samples holds 30% of the squared error, or when it doubles between one sample and many. A finite
// variance is known better with every sample, an infinite one never is.
constexpr double suspect_error = 0.25; // standard error / variance
constexpr double suspect_error_of_few = 0.1, suspect_top_share = 0.3;
constexpr double suspect_growth = 2.0;
// Two tests of each of about 60 rows: false alarms in 1% of reports, where means are normal.
constexpr double significant = 1e-4;
// Of the mean: what sums of float32 may be off by, whatever their noise.
constexpr double rounding = 1e-5;

std::vector<double> doubling_times(double seconds) {
  std::vector<double> times;
  for (std::size_t i = doublings; i >= 1; --i) times.push_back(seconds / std::pow(2.0, i));
  return times;
}

struct Look { // at an image on the way
  std::size_t time = 0;
  double seconds = 0, samples_per_pixel = 0, relmse = 0;
};

double mean_samples(const ImageEstimate& image) {
  return std::accumulate(image.samples.begin(), image.samples.end(), 0.0) /
         static_cast<double>(image.samples.size());
}

Look look_at(const Snapshot& snapshot, const Reference& reference) {
  return {snapshot.time, snapshot.seconds, mean_samples(snapshot.image),
          relative_mse(snapshot.image, reference)};
}

// The renders of one method, as they come.
struct Renders {
  std::vector<ImageEstimate> last, one_sample;
  std::vector<double> seconds_per_sample, processor_seconds_per_sample;
  std::vector<Look> looks; // at all renders; time `doublings` is a render's end

  void add(TimedRender render, const Reference& reference) {
    seconds_per_sample.push_back(render.seconds_per_sample());
    processor_seconds_per_sample.push_back(render.processor_seconds_per_sample);
    for (const Snapshot& snapshot : render.on_the_way) looks.push_back(look_at(snapshot, reference));
    looks.push_back(look_at(render.last, reference));
    last.push_back(std::move(render.last.image));
    one_sample.push_back(std::move(*render.one_sample));
  }
};

bool is_black(Repeats images) {
  return std::ranges::all_of(images, [](const ImageEstimate& image) {
    return std::ranges::all_of(image.radiance, [](double value) { return value == 0; });
  });
}

// Means over 9x9 pixels. An image's own large samples would make their pixels count for little.
Reference smoothed(const Reference& image, const scene::Camera& camera) {
  constexpr int reach = 4;
  Reference result(image.size());
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      std::array<double, 3> sum{};
      int pixels = 0;
      for (int j = std::max(0, y - reach); j <= std::min(camera.height - 1, y + reach); ++j)
        for (int i = std::max(0, x - reach); i <= std::min(camera.width - 1, x + reach); ++i, ++pixels)
          for (std::size_t channel = 0; channel < 3; ++channel)
            sum[channel] += image[3 * static_cast<std::size_t>(j * camera.width + i) + channel];
      for (std::size_t channel = 0; channel < 3; ++channel)
        result[3 * static_cast<std::size_t>(y * camera.width + x) + channel] = sum[channel] / pixels;
    }
  return result;
}

// Of the doubling times, those that half of the renders have an image of.
std::vector<ConvergencePoint> convergence_of(const Renders& renders) {
  std::vector<ConvergencePoint> points;
  for (std::size_t time = 0; time <= doublings; ++time) {
    std::vector<double> seconds, samples, errors;
    for (const Look& look : renders.looks) {
      if (look.time != time) continue;
      seconds.push_back(look.seconds);
      samples.push_back(look.samples_per_pixel);
      errors.push_back(look.relmse);
    }
    if (2 * errors.size() < renders.last.size()) continue;
    const auto [least, most] = std::ranges::minmax(errors);
    const double mean =
        std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
    points.push_back({median(seconds), median(samples), mean, least, most, static_cast<int>(errors.size())});
  }
  return points;
}

void judge_variance(MethodResult& result, const Renders& renders, const Reference& reference) {
  if (!(result.variance.value > 0)) {
    if (result.verdict == Verdict::sound) return;
    result.verdict = Verdict::suspect_variance;
    result.reason = "no two samples differ: those that carry the light were never met";
    return;
  }
  const double error = result.variance.standard_error / result.variance.value;
  if (error > suspect_error || (error > suspect_error_of_few && result.top_share > suspect_top_share)) {
    result.verdict = Verdict::suspect_variance;
    result.reason = fmt::format("the variance is only known to {:.0f}%: the largest 0.1% of the samples hold "
                                "{:.0f}% of the squared error",
                                100 * error, 100 * result.top_share);
    return;
  }
  const Figure growth = log_growth(renders.last, renders.one_sample, reference);
  if (growth.value > std::log(suspect_growth) && p_value(growth, 0, renders.last.size()) < significant) {
    result.verdict = Verdict::suspect_variance;
    result.reason =
        fmt::format("the variance grew {:.1f} times with the number of samples", std::exp(growth.value));
  }
}

void judge_mean(MethodResult& result, const Renders& renders, const ReferenceImage& reference,
                const std::string& known) {
  const Figure unexplained = unexplained_mse(renders.last, reference.radiance);
  const Figure difference{result.mean.value - reference.mean.value,
                          std::hypot(result.mean.standard_error, reference.mean.standard_error)};
  if (difference.standard_error > 0) result.mean_bias_sigma = difference.value / difference.standard_error;
  // The reference's error has fewer degrees of freedom than the rounds; its part in the sum is small.
  const bool mean_differs = std::abs(difference.value) > rounding * reference.mean.value &&
                            p_value(difference, 0, renders.last.size()) < significant;
  const bool pixels_differ = unexplained.value > 2 * reference.relmse + rounding * rounding &&
                             p_value(unexplained, reference.relmse, renders.last.size()) < significant;
  if (!known.empty())
    result.reason = known;
  else if (mean_differs)
    result.reason = fmt::format("the image's mean is {:+.2g}% off the reference's ({:+.1f} sigma)",
                                100 * difference.value / reference.mean.value, result.mean_bias_sigma);
  else if (pixels_differ)
    result.reason = fmt::format("a relative MSE of {:.2g} remains whatever the samples", unexplained.value);
  if (!known.empty() || mean_differs || pixels_differ) result.verdict = Verdict::biased;
}

MethodResult result_of(const Method& method, const Renders& renders, const ReferenceImage& reference,
                       const std::string& known) {
  MethodResult result{.method = method};
  result.rounds = static_cast<int>(renders.last.size());
  result.variance = variance_per_sample(renders.last, reference.radiance);
  result.top_share = top_share(renders.one_sample, reference.radiance);
  result.mean = image_mean(renders.last);
  result.seconds_per_sample = median(renders.seconds_per_sample);
  result.processor_seconds_per_sample = median(renders.processor_seconds_per_sample);
  const auto [least, most] = std::ranges::minmax(renders.seconds_per_sample);
  result.seconds_per_sample_least = least, result.seconds_per_sample_most = most;
  result.convergence = convergence_of(renders);
  result.first_image = renders.last.front();
  judge_mean(result, renders, reference, known);
  // A few large samples that most renders miss look like a bias too.
  if (known.empty()) judge_variance(result, renders, reference.radiance);
  return result;
}

} // namespace

const char* word_of(Verdict verdict) {
  constexpr std::array<const char*, 4> words = {"sound", "suspect", "biased", "refused"};
  return words[static_cast<std::size_t>(verdict)];
}

render::Settings render_settings(const Method& method, const scene::Scene& scene,
                                 const SceneBenchSettings& settings) {
  render::Settings result = settings_of(method, scene.defaults);
  result.devices = settings.devices;
  result.lanes = settings.lanes;
  result.kernel_dir = settings.kernel_dir;
  result.seed = settings.seed;
  return result;
}

SceneBench::SceneBench(const scene::Scene& scene, const SceneBenchSettings& settings)
    : scene_(scene), settings_(settings), begin_(Clock::now()) {}

render::Settings SceneBench::settings_for(const Method& method) const {
  return render_settings(method, scene_, settings_);
}

double SceneBench::seconds_left() const {
  return settings_.seconds - seconds_since(begin_);
}

void SceneBench::say(const std::string& what) const {
  if (settings_.interrupted && settings_.interrupted()) throw Interrupted{};
  if (settings_.report) settings_.report(what);
}

Trial SceneBench::try_method(const Method& method, double seconds) const try {
  Trial trial{.method = method};
  render::Settings settings = settings_for(method);
  double paths = 0, rendering = 0;
  for (int i = 0; i < settings_.trial_renders; ++i) {
    settings.seed = settings_.seed + first_trial_seed + static_cast<std::uint64_t>(i);
    TimedRender render = render_for(scene_, settings, seconds, {}, settings_.interrupted);
    paths += render.paths;
    rendering += render.last.seconds;
    trial.images.push_back(std::move(render.last.image));
  }
  trial.seconds_per_sample = rendering / paths;
  return trial;
} catch (const UsageError& error) {
  return {.method = method, .refusal = error.what()};
} catch (const SceneError& error) {
  return {.method = method, .refusal = error.what()};
}

void SceneBench::try_methods(const std::vector<Method>& methods) {
  const double seconds = std::clamp(trial_share * settings_.seconds, least_seconds, 0.5);
  double beyond = 0;
  int renders = 0;
  for (const Method& method : methods) {
    say("trying " + method.name());
    trials_.push_back(try_method(method, seconds));
    if (!trials_.back().refusal.empty()) continue;
    // Once more, now that its kernels are there: what a round's two renders cost beside rendering.
    const Clock::time_point begin = Clock::now();
    (void)render_for(scene_, settings_for(method), least_seconds, {}, settings_.interrupted);
    (void)render_one_sample(scene_, settings_for(method));
    beyond += seconds_since(begin) - least_seconds;
    ++renders;
  }
  overhead_ = renders > 0 ? beyond / renders : 0;
  rate_trials();
}

// Which one converges best, in two steps: by the variance in absolute terms, then relative to that one's
// image, smoothed.
void SceneBench::rate_trials() {
  const auto rate = [&](const Reference& reference) {
    for (Trial& trial : trials_) {
      if (!trial.refusal.empty()) continue;
      const Figure variance = variance_per_sample(trial.images, reference);
      trial.variance = variance.value + 3 * variance.standard_error;
    }
  };
  const auto first = std::ranges::find(trials_, "", &Trial::refusal);
  if (first == trials_.end()) return;
  rate(Reference(first->images.front().radiance.size(), 1.0));
  if (const Trial* best = best_trial()) rate(smoothed(pooled(best->images).radiance, scene_.camera));
}

// One whose samples have met no light at all has no variance, which is not to its credit.
const Trial* SceneBench::best_trial() const {
  const auto black = [](const Trial& trial) { return is_black(trial.images); };
  const bool all_black = std::ranges::all_of(trials_, black);
  const Trial* best = nullptr;
  for (const Trial& trial : trials_)
    if (trial.refusal.empty() && known_bias(trial.method, scene_).empty() && (all_black || !black(trial)))
      if (best == nullptr ||
          trial.variance * trial.seconds_per_sample < best->variance * best->seconds_per_sample)
        best = &trial;
  return best;
}

ReferenceImage SceneBench::reference() const {
  const Trial* best = best_trial();
  if (best == nullptr)
    throw SceneError(fmt::format("no method can make a reference: {}",
                                 trials_.empty() ? "none was asked for" : trials_.front().refusal));
  say("reference by " + best->method.name());
  const double seconds = std::max(reference_share * seconds_left(), 8 * least_seconds);
  return make_reference(scene_, best->method, settings_for(best->method), seconds, settings_.interrupted);
}

std::vector<MethodResult> SceneBench::measure(const ReferenceImage& reference) const {
  std::vector<const Trial*> able;
  for (const Trial& trial : trials_)
    if (trial.refusal.empty()) able.push_back(&trial);
  const double count = std::max<double>(1, static_cast<double>(able.size()));
  const double left = std::max(0.0, seconds_left()) / count;
  const int rounds = std::clamp(static_cast<int>(left / (overhead_ + 2 * least_seconds)),
                                settings_.least_rounds, settings_.most_rounds);
  const double seconds = std::max(least_seconds, left / rounds - overhead_);
  std::vector<Renders> renders(able.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < able.size(); ++i) {
      say(fmt::format("round {} of {}, {}", round + 1, rounds, able[i]->method.name()));
      render::Settings settings = settings_for(able[i]->method);
      settings.seed = settings_.seed + static_cast<std::uint64_t>(round);
      TimedRender render =
          render_for(scene_, settings, seconds, doubling_times(seconds), settings_.interrupted);
      if (!render.one_sample) render.one_sample = render_one_sample(scene_, settings);
      renders[i].add(std::move(render), reference.radiance);
    }

  std::vector<MethodResult> results;
  for (const Trial& trial : trials_) {
    const auto found = std::ranges::find(able, &trial);
    results.push_back(
        found == able.end()
            ? MethodResult{.method = trial.method, .verdict = Verdict::refused, .reason = trial.refusal}
            : result_of(trial.method, renders[static_cast<std::size_t>(found - able.begin())], reference,
                        known_bias(trial.method, scene_)));
  }
  return results;
}

} // namespace phlux::bench
