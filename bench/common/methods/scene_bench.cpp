#include "bench/common/methods/scene_bench.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "accel/geometry.h"
#include "errors.h"
#include "measure/moments.h"

namespace phlux::bench {
namespace {

constexpr std::uint64_t first_trial_seed = 1'000'000;
constexpr double trial_share = 0.15;                        // of the time of the scene
constexpr int least_trials = 3, most_trials = 6;            // per method; more reveal rarer large samples
constexpr double reference_share = 0.15;                    // of the time that is left after the trials
constexpr double least_seconds = 0.03, longest_trial = 0.5; // per render
constexpr double tolerated_excess = 1.1;                    // of the time of the scene
// The tables of this many primitives, over all methods, are kept on the devices between renders.
constexpr std::size_t most_kept_primitives = 4'000'000;

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

// Variances that the rounds of its own method show may exceed those of the few repeats of the reference.
void raise_variance(ReferenceImage& reference, double variance_per_sample) {
  const double own = reference.image.relmse() * reference.samples_per_pixel;
  if (!(variance_per_sample > own) || !(own > 0)) return;
  const double factor = variance_per_sample / own;
  for (double& variance : reference.image.variance) variance *= factor;
  reference.mean.standard_error *= std::sqrt(factor);
}

// Without a trustworthy reference nobody can be shown to be biased.
void doubt_reference(std::vector<MethodResult>& results, const ReferenceImage& reference,
                     const KnownBias& known_bias) {
  const auto doubtful = [&](const MethodResult& result) {
    return result.method.name() == reference.method && result.verdict == Verdict::suspect_variance;
  };
  if (std::ranges::none_of(results, doubtful)) return;
  for (MethodResult& result : results)
    if (result.verdict == Verdict::biased && known_bias.of(result.method).empty())
      result.decide(Verdict::undecided, result.reason + ", whose own variance is suspect");
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
    : scene_(scene), settings_(settings),
      known_bias_(scene, render_settings({"path", render::Settings().strategy, "none"}, scene, settings)),
      begin_(Clock::now()) {}

double SceneBench::seconds_left() const {
  return settings_.seconds - seconds_since(begin_);
}

// At least a second is left until the end.
void SceneBench::report_step(const std::string& what, double seconds_left) const {
  if (settings_.interrupted && settings_.interrupted()) throw Interrupted{};
  if (settings_.report) settings_.report(what, std::max(1.0, seconds_left));
}

MethodRenderer& SceneBench::renderer_of(Trial& trial) const {
  if (!trial.renderer)
    trial.renderer =
        std::make_unique<MethodRenderer>(scene_, render_settings(trial.method, scene_, settings_));
  return *trial.renderer;
}

void SceneBench::release(Trial& trial) const {
  if (!keep_renderers_) trial.renderer.reset();
}

Trial SceneBench::try_method(const Method& method, double seconds, int renders) const try {
  Trial trial{.method = method};
  MethodRenderer& renderer = renderer_of(trial);
  std::vector<double> seconds_per_sample, least;
  for (int i = 0; i < renders; ++i) {
    const std::uint64_t seed = settings_.seed + first_trial_seed + static_cast<std::uint64_t>(i);
    TimedRender render = renderer.render_for(seed, seconds, {}, settings_.interrupted);
    seconds_per_sample.push_back(render.seconds_per_sample);
    least.push_back(render.last.seconds / render.samples_per_pixel());
    trial.images.push_back(std::move(render.last.image));
  }
  trial.seconds_per_sample = measure::median(seconds_per_sample);
  trial.least_seconds = measure::median(least);
  release(trial);
  return trial;
} catch (const UsageError& error) {
  return {.method = method, .refusal = error.what()};
} catch (const SceneError& error) {
  return {.method = method, .refusal = error.what()};
}

void SceneBench::try_methods(const std::vector<Method>& methods) {
  keep_renderers_ = accel::count_primitives(scene_) * methods.size() <= most_kept_primitives;
  const double share = trial_share * settings_.seconds / static_cast<double>(methods.size());
  const int renders = std::clamp(static_cast<int>(share / least_seconds), least_trials, most_trials);
  const double seconds = std::clamp(share / renders, least_seconds, longest_trial);
  for (const Method& method : methods) {
    report_step("trial of " + method.name(), seconds_left());
    trials_.push_back(try_method(method, seconds, renders));
  }
  rate_trials();
}

// Estimates the variances twice: first in absolute terms, then relative to the image of the method that the
// first pass rates best.
void SceneBench::rate_trials() {
  const auto rate = [&](const Reference& reference) {
    for (Trial& trial : trials_) {
      if (!trial.refusal.empty()) continue;
      const Estimate variance = mean_of(variances_per_sample(trial.images, reference));
      trial.variance = variance.value + 3 * variance.standard_error;
    }
  };
  const auto first = std::ranges::find(trials_, "", &Trial::refusal);
  if (first == trials_.end()) return;
  rate(exact_reference(std::vector<double>(first->images.front().radiance.size(), 1.0)));
  if (const Trial* best = best_trial())
    rate(pooled_reference(best->images, static_cast<std::size_t>(scene_.camera.width)));
}

// A method whose images are all black has variance 0: it is rated only if all are black.
Trial* SceneBench::best_trial() {
  const auto black = [](const Trial& trial) { return is_black(trial.images); };
  const bool all_black = std::ranges::all_of(trials_, black);
  Trial* best = nullptr;
  for (Trial& trial : trials_)
    if (trial.refusal.empty() && known_bias_.of(trial.method).empty() && (all_black || !black(trial)))
      if (best == nullptr ||
          trial.variance * trial.seconds_per_sample < best->variance * best->seconds_per_sample)
        best = &trial;
  return best;
}

ReferenceImage SceneBench::reference() {
  Trial* best = best_trial();
  if (best == nullptr)
    throw SceneError(fmt::format("no method can render a reference: {}",
                                 trials_.empty() ? "no methods are given" : trials_.front().refusal));
  report_step("reference by " + best->method.name(), seconds_left());
  const double seconds = std::max(reference_share * seconds_left(), 8 * least_seconds);
  const ReferenceImage reference = make_reference(renderer_of(*best), best->method, scene_.camera,
                                                  settings_.seed, seconds, settings_.interrupted);
  release(*best);
  return reference;
}

std::vector<Trial*> SceneBench::accepted() {
  std::vector<Trial*> result;
  for (Trial& trial : trials_)
    if (trial.refusal.empty()) result.push_back(&trial);
  return result;
}

// The time of a round follows from the time that is left when it begins, so that other load on the machine
// makes the rounds shorter and the measurement not longer.
std::vector<MethodRenders> SceneBench::run_rounds(const std::vector<Trial*>& methods,
                                                  const ReferenceImage& reference) {
  const auto count = std::max<double>(1, static_cast<double>(methods.size()));
  double least = 0; // seconds of a round
  for (const Trial* trial : methods) least += std::max(least_seconds, trial->least_seconds);
  const int rounds = std::clamp(static_cast<int>(seconds_left() / (2 * least)), settings_.least_rounds,
                                std::max(settings_.least_rounds, settings_.most_rounds));
  const double shortest = seconds_since(begin_) + rounds * least;
  if (shortest > tolerated_excess * settings_.seconds && settings_.notice)
    settings_.notice(
        fmt::format("this takes about {:.2g} s instead of {:.2g} s: {} rounds with one sample per pixel "
                    "or more by each of {} methods",
                    shortest, settings_.seconds, rounds, methods.size()));
  std::vector<MethodRenders> renders(methods.size());
  double overhead = 0; // seconds of a render beyond the requested ones
  for (int round = 0; round < rounds; ++round) {
    const double of_round = seconds_left() / (rounds - round);
    const double seconds = std::max(least_seconds, of_round / count - overhead);
    const Clock::time_point begin = Clock::now();
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const double done = static_cast<double>(i) / count;
      report_step(fmt::format("round {} of {}, {}", round + 1, rounds, methods[i]->method.name()),
                  std::max(of_round, least) * (rounds - round - done));
      const std::uint64_t seed = settings_.seed + static_cast<std::uint64_t>(round);
      MethodRenderer& renderer = renderer_of(*methods[i]);
      TimedRender render = renderer.render_for(seed, seconds, doubling_times(seconds), settings_.interrupted);
      if (!render.one_sample) render.one_sample = renderer.render_one_sample(seed).one_sample;
      renders[i].add(std::move(render), reference.image);
      release(*methods[i]);
    }
    const double taken = seconds_since(begin);
    overhead = std::max(0.0, taken / count - seconds);
    least = std::max(least, std::min(taken, count * (least_seconds + overhead)));
  }
  return renders;
}

std::vector<MethodResult> SceneBench::measure(ReferenceImage& reference) {
  const std::vector<Trial*> methods = accepted();
  const std::vector<MethodRenders> renders = run_rounds(methods, reference);
  for (std::size_t i = 0; i < methods.size(); ++i)
    if (methods[i]->method.name() == reference.method)
      raise_variance(reference, renders[i].variance(reference.image).value);
  std::vector<MethodResult> results;
  std::size_t next = 0;
  for (const Trial& trial : trials_)
    results.push_back(
        trial.refusal.empty()
            ? renders[next++].result(trial.method, reference, known_bias_.of(trial.method))
            : MethodResult{.method = trial.method, .verdict = Verdict::refused, .reason = trial.refusal});
  doubt_reference(results, reference, known_bias_);
  return results;
}

} // namespace phlux::bench
