#include "advice/automatic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "errors.h"
#include "measure/statistics.h"
#include "scene/image_size.h"
#include "scene/lights.h"

namespace phlux::advice {
namespace {

using Texts = std::map<std::string, std::string>;

constexpr int first_samples = 16, most_samples = 2048;
constexpr int most_variants = 2; // of variants_of()
constexpr double path_seconds =
    150e-9; // of a path by `integrator` path, for a render's time before any trial

// Seconds of one core per ray on the shipped scenes (PoCL, 16 lanes), of which only ratios matter: tracing it
// through a few shapes or a hierarchy, and the integrator's work on what it finds.
double seconds_per_ray(const scene::Scene& scene, const std::string& traversal,
                       settings::Integrator integrator) {
  std::size_t shapes = scene.patches.size() + scene.spheres.size();
  for (const scene::Mesh& mesh : scene.meshes) shapes += mesh.triangles.size();
  const double tracing = traversal == "bvh" ? 12e-9 * std::log2(static_cast<double>(shapes)) : 8e-9;
  constexpr std::array of_integrator = {16e-9, 12e-9, 30e-9}; // path, light, bidir
  return tracing + of_integrator[static_cast<std::size_t>(integrator)];
}

// The relative standard error, which rare bright samples make too small in a short trial, times the factor
// that gives normal intervals of 95% the coverage that is predicted.
double widened_error(const Trial& trial) {
  const double coverage = std::clamp(trial.reliability.coverage, 0.01, film::nominal_coverage);
  return trial.relative_standard_error * measure::normal_sigmas(1 - film::nominal_coverage) /
         measure::normal_sigmas(1 - coverage);
}

// A method that is tried.
struct Candidate {
  Texts texts;
  render::Settings settings;
  Trial trial;
  double sample_seconds = 0.0; // by its rays
};

class Trials {
public:
  Trials(const scene::Scene& scene, const settings::Choices& choices, const render::Settings& defaults)
      : scene_(scene), choices_(choices), defaults_(defaults) {}

  // Nothing if the choices exclude the method; `refusal` is why.
  std::optional<Candidate> candidate(const Texts& texts) {
    settings::Choices with = choices_;
    for (const auto& [name, text] : texts) with.texts.insert_or_assign(name, text);
    try {
      render::Settings settings = settings::settings_of(with, scene_.defaults, defaults_);
      return Candidate{.texts = texts, .settings = std::move(settings), .trial = {}};
    } catch (const UsageError& error) {
      refusal = error.what();
      return std::nullopt;
    }
  }

  void run(Candidate& c, int samples) const {
    render::Settings with = trial_settings(c.settings);
    with.samples_per_pixel = samples;
    c.trial = try_method(scene_, with);
    const render::Statistics& s = c.trial.statistics;
    if (!c.trial.refusal.empty() || s.paths == 0) return;
    const double rays = static_cast<double>(s.rays + s.shadow_rays) / static_cast<double>(s.paths);
    const auto integrator = settings::integrator_named(with.integrator).integrator;
    c.sample_seconds = rays * seconds_per_ray(scene_, s.traversal, integrator);
    const double error = widened_error(c.trial);
    c.trial.cost = error * error * samples * c.sample_seconds;
  }

  [[nodiscard]] double pixels() const {
    return static_cast<double>(scene_.camera.width) * scene_.camera.height;
  }

  std::string refusal;

private:
  const scene::Scene& scene_;
  const settings::Choices& choices_;
  const render::Settings& defaults_;
};

// Methods that can be compared before those that cannot; then by their costs, or by how little their errors
// mislead.
bool is_better(const Candidate& a, const Candidate& b) {
  const bool a_comparable = is_comparable(a.trial), b_comparable = is_comparable(b.trial);
  if (a_comparable != b_comparable) return a_comparable;
  if (a_comparable) return a.trial.cost < b.trial.cost;
  return a.trial.reliability.coverage > b.trial.reliability.coverage;
}

// Seconds of one core that the render takes by the best of the candidates, as far as is known.
double seconds_of_render(const render::Settings& settings, double pixels, std::span<const Candidate> tried) {
  if (settings.time_limit) return *settings.time_limit;
  const auto best = std::ranges::min_element(tried, is_better);
  if (!settings.target_error) {
    const double each = best == tried.end() ? path_seconds : best->sample_seconds;
    return settings.samples_per_pixel * pixels * each;
  }
  if (best == tried.end()) return std::numeric_limits<double>::infinity();
  return pixels * best->trial.cost / (*settings.target_error * *settings.target_error);
}

// Samples per pixel of a render by a method that was tried, as far as is known.
double samples_of_render(const render::Settings& settings, double pixels, const Candidate& method) {
  if (!settings.time_limit && !settings.target_error) return settings.samples_per_pixel;
  return seconds_of_render(settings, pixels, {&method, 1}) / (pixels * method.sample_seconds);
}

// Other values of a setting, by its name, with which the integrator may be better than with the default.
std::vector<std::pair<std::string, std::string>> variants_of(const std::string& integrator,
                                                             const scene::Scene& scene) {
  if (integrator == "bidir") return {{"weights", "power"}};
  if (integrator != "path") return {};
  if (has_unhittable_lights(scene))
    return {{"connect", "light"}}; // without connections no path finds such lights
  return {{"connect", "light"}, {"connect", "none"}};
}

// Lattices need fewer samples than independent points (bench/saved/SAMPLERS.md). Their MSE decreases as
// n^-1.1 with the number n of samples of a pixel, from about 32 samples on and until their sets have 64
// points each. With less than about 100 samples the gain is small, and a bad error estimate is more often
// taken for a good one (bench/saved/COVERAGE.md). They do not help `light`, whose samples are not those of a
// pixel.
constexpr double fewest_for_point_sets = 128;
double cost_ratio_of_point_sets(double samples) {
  return std::pow(std::min(samples, 1024.0) / 32.0, -0.1);
}

// Lets a candidate sample by lattices in a render with that many samples per pixel, if they help.
void use_point_sets(Candidate& c, double samples, Trials& trials, const settings::Choices& choices) {
  if (!(samples >= fewest_for_point_sets) || c.settings.integrator == "light" || choices.has("sampler"))
    return;
  Texts texts = c.texts;
  texts["sampler"] = "lattice";
  const auto with_lattice = trials.candidate(texts);
  if (!with_lattice) return;
  c.texts = texts;
  c.trial.method = method_of(with_lattice->settings);
  c.trial.cost *= cost_ratio_of_point_sets(samples);
}

std::string words_for(const std::vector<Candidate>& sorted) {
  const Candidate& best = sorted.front();
  if (!is_comparable(best.trial)) return fmt::format("{}: trials were too noisy to tell", best.trial.method);
  if (sorted.size() == 1)
    return fmt::format("{}: no other method can render this scene with these options", best.trial.method);
  if (!is_comparable(sorted[1].trial))
    return fmt::format("{}: in trials, no other method had a reliable error estimate", best.trial.method);
  const double times = sorted[1].trial.cost / best.trial.cost;
  return fmt::format("{}: in trials {}as efficient as {}", best.trial.method,
                     times < 1.1 ? "about " : fmt::format("{:.2g} times ", times), sorted[1].trial.method);
}

} // namespace

bool misses_light(const scene::Scene& scene, const settings::IntegratorInfo& integrator) {
  return integrator.eye_paths ? eye_paths_miss_light(scene) && !integrator.light_paths : has_delta(scene);
}

MethodChoice choose_method(scene::Scene scene, const settings::Choices& choices,
                           const render::Settings& defaults) {
  const double pixels = static_cast<double>(scene.camera.width) * scene.camera.height;
  scene::shrink_image(scene.camera, trial_side);
  Trials trials(scene, choices, defaults);
  std::vector<Candidate> candidates;
  for (const settings::IntegratorInfo& info : settings::integrators)
    if (!misses_light(scene, info))
      if (auto candidate = trials.candidate({{"integrator", info.name}})) candidates.push_back(*candidate);
  if (candidates.empty()) throw UsageError(trials.refusal);

  const double first_seconds =
      first_samples * trials.pixels() * path_seconds * 2.0 * static_cast<double>(candidates.size());
  const render::Settings settings = candidates.front().settings; // of the amount of samples: that of all
  if (candidates.size() == 1 || share_for_trials * seconds_of_render(settings, pixels, {}) < first_seconds)
    return {.texts = candidates.front().texts,
            .words = fmt::format("{}: {}", method_of(settings),
                                 candidates.size() == 1
                                     ? "no other method can render this scene with these options"
                                     : "the render is too short for trials")};
  for (Candidate& c : candidates) trials.run(c, first_samples);
  std::erase_if(candidates, [](const Candidate& c) { return !c.trial.refusal.empty(); });
  if (candidates.empty()) throw UsageError("no integrator can render this scene");

  // Each of the trials to come may take as long: one for each integrator, and those for variants of the best.
  const double seconds = share_for_trials * seconds_of_render(settings, pixels, candidates) - first_seconds;
  const auto samples_for = [&](const Candidate& c) {
    const double each = seconds / static_cast<double>(candidates.size() + most_variants);
    return static_cast<int>(std::min(each / (trials.pixels() * c.sample_seconds), double{most_samples}));
  };
  for (Candidate& c : candidates)
    if (const int samples = samples_for(c); samples >= 2 * first_samples) trials.run(c, samples);
  std::ranges::sort(candidates, is_better);

  const Candidate best = candidates.front();
  for (const auto& [name, text] : variants_of(best.settings.integrator, scene)) {
    Texts texts = best.texts;
    texts[name] = text;
    auto variant = choices.has(name) ? std::nullopt : trials.candidate(texts);
    if (!variant) continue;
    trials.run(*variant, std::max(samples_for(best), first_samples));
    if (variant->trial.refusal.empty()) candidates.push_back(*variant);
  }
  for (Candidate& c : candidates) use_point_sets(c, samples_of_render(settings, pixels, c), trials, choices);
  std::ranges::sort(candidates, is_better);
  return {.texts = candidates.front().texts, .words = words_for(candidates)};
}

} // namespace phlux::advice
