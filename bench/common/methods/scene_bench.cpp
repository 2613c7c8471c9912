#include "bench/common/methods/scene_bench.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "bench/common/methods/timed_render.h"
#include "errors.h"
#include "measure/moments.h"

namespace phlux::bench {
namespace {

constexpr std::uint64_t first_trial_seed = 1'000'000;
constexpr double trial_share = 1.0 / 400; // of the time of the scene, for one trial render
constexpr double reference_share = 0.15;  // of the time that is left after the trials
constexpr double least_seconds = 0.03;    // per render

std::vector<double> doubling_times(double seconds) {
  std::vector<double> times;
  for (std::size_t i = doublings; i >= 1; --i) times.push_back(seconds / std::pow(2.0, i));
  return times;
}

bool is_black(Repeats images) {
  return std::ranges::all_of(images, [](const ImageEstimate& image) {
    return std::ranges::all_of(image.radiance, [](double value) { return value == 0; });
  });
}

// Means over 9x9 pixels. Without smoothing, a large sample would raise its own reference value and so lower
// the weight of its pixel.
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

} // namespace

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

void SceneBench::report_step(const std::string& what) const {
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
  double overhead = 0;
  int renders = 0;
  for (const Method& method : methods) {
    report_step("trial of " + method.name());
    trials_.push_back(try_method(method, seconds));
    if (!trials_.back().refusal.empty()) continue;
    // The kernels are built now. Measures the time that the two renders of a round take beyond rendering.
    const Clock::time_point begin = Clock::now();
    (void)render_for(scene_, settings_for(method), least_seconds, {}, settings_.interrupted);
    (void)render_one_sample(scene_, settings_for(method));
    overhead += seconds_since(begin) - least_seconds;
    ++renders;
  }
  overhead_ = renders > 0 ? overhead / renders : 0;
  rate_trials();
}

// Estimates the variances twice: first in absolute terms, then relative to the smoothed image of the method
// that the first pass rates best.
void SceneBench::rate_trials() {
  const auto rate = [&](const Reference& reference) {
    for (Trial& trial : trials_) {
      if (!trial.refusal.empty()) continue;
      const Estimate variance = variance_per_sample(trial.images, reference);
      trial.variance = variance.value + 3 * variance.standard_error;
    }
  };
  const auto first = std::ranges::find(trials_, "", &Trial::refusal);
  if (first == trials_.end()) return;
  rate(Reference(first->images.front().radiance.size(), 1.0));
  if (const Trial* best = best_trial()) rate(smoothed(pooled(best->images).radiance, scene_.camera));
}

// A method whose images are all black has variance 0: it is rated only if all are black.
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
    throw SceneError(fmt::format("no method can render a reference: {}",
                                 trials_.empty() ? "no methods are given" : trials_.front().refusal));
  report_step("reference by " + best->method.name());
  const double seconds = std::max(reference_share * seconds_left(), 8 * least_seconds);
  return make_reference(scene_, best->method, settings_for(best->method), seconds, settings_.interrupted);
}

std::vector<MethodResult> SceneBench::measure(const ReferenceImage& reference) const {
  std::vector<const Trial*> accepted;
  for (const Trial& trial : trials_)
    if (trial.refusal.empty()) accepted.push_back(&trial);
  const double count = std::max<double>(1, static_cast<double>(accepted.size()));
  const double left = std::max(0.0, seconds_left()) / count;
  const int rounds = std::clamp(static_cast<int>(left / (overhead_ + 2 * least_seconds)),
                                settings_.least_rounds, settings_.most_rounds);
  const double seconds = std::max(least_seconds, left / rounds - overhead_);
  std::vector<MethodRenders> renders(accepted.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < accepted.size(); ++i) {
      report_step(fmt::format("round {} of {}, {}", round + 1, rounds, accepted[i]->method.name()));
      render::Settings settings = settings_for(accepted[i]->method);
      settings.seed = settings_.seed + static_cast<std::uint64_t>(round);
      TimedRender render =
          render_for(scene_, settings, seconds, doubling_times(seconds), settings_.interrupted);
      if (!render.one_sample) render.one_sample = render_one_sample(scene_, settings);
      renders[i].add(std::move(render), reference.radiance);
    }

  std::vector<MethodResult> results;
  for (const Trial& trial : trials_) {
    const auto found = std::ranges::find(accepted, &trial);
    results.push_back(
        found == accepted.end()
            ? MethodResult{.method = trial.method, .verdict = Verdict::refused, .reason = trial.refusal}
            : renders[static_cast<std::size_t>(found - accepted.begin())].result(
                  trial.method, reference, known_bias(trial.method, scene_)));
  }
  return results;
}

} // namespace phlux::bench
