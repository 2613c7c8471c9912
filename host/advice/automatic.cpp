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
// Trials with fewer samples hardly show caustics that path finds by chance only: with 16 to 64 of them it
// seemed two to three times as efficient as bidir on glass-caustic, where it takes 20 times as long.
constexpr int samples_for_caustics = 200;
constexpr double factor_for_caustics = 4.0; // of the cost
// Predicted coverage of 95% intervals below which a cost says nothing.
constexpr double least_coverage = 0.25;
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

// The squared factor that gives normal intervals of 95% the coverage that is predicted. Rare bright samples
// make the variance too small in a short trial. Coverages that are not comparable are too inaccurate for
// larger factors.
double widening(const film::Reliability& reliability) {
  const double coverage = std::clamp(reliability.coverage, comparable_coverage, film::nominal_coverage);
  const double factor =
      measure::normal_sigmas(1 - film::nominal_coverage) / measure::normal_sigmas(1 - coverage);
  return factor * factor;
}

// A method that is tried.
struct Candidate {
  Texts texts;
  render::Settings settings;
  Trial trial;
  double sample_seconds = 0.0; // by its rays
  int trial_samples = 0;
  double trial_seconds = 0.0; // per pixel
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

  // The cost is of the trial alone, see correct_costs().
  void run(Candidate& c, int samples) {
    render::Settings with = trial_settings(c.settings);
    with.samples_per_pixel = samples;
    c.trial = try_method(scene_, with, known_);
    const render::Statistics& s = c.trial.statistics;
    if (!c.trial.refusal.empty() || s.paths == 0) return;
    const double rays = static_cast<double>(s.rays + s.shadow_rays) / static_cast<double>(s.paths);
    const auto integrator = settings::integrator_named(with.integrator).integrator;
    c.sample_seconds = rays * seconds_per_ray(scene_, s.traversal, integrator);
    c.trial_samples = samples;
    c.trial_seconds = samples * c.sample_seconds;
    c.trial.cost = c.trial.reliability.variance * widening(c.trial.reliability) * c.sample_seconds;
  }

  [[nodiscard]] double pixels() const {
    return static_cast<double>(scene_.camera.width) * scene_.camera.height;
  }

  std::string refusal;

private:
  const scene::Scene& scene_;
  const settings::Choices& choices_;
  const render::Settings& defaults_;
  tables::KnownGeometry known_;
};

// Adds to the costs the light that the trials lack.
void correct_costs(std::vector<Candidate>& candidates, const scene::Scene& scene) {
  std::vector<Trial> trials;
  for (const Candidate& c : candidates) trials.push_back(c.trial);
  for (Candidate& c : candidates) {
    const double missing = missing_error(c.trial, trials);
    c.trial.cost += missing * missing * c.trial_seconds;
    if (finds_caustics_by_chance(scene, c.settings.integrator) && c.trial_samples < samples_for_caustics)
      c.trial.cost *= factor_for_caustics;
  }
}

// Methods whose costs say something before the others; then by their costs.
bool is_better(const Candidate& a, const Candidate& b) {
  const auto says_something = [](const Trial& trial) {
    return trial.cost > 0.0 && trial.reliability.coverage >= least_coverage;
  };
  if (says_something(a.trial) != says_something(b.trial)) return says_something(a.trial);
  return a.trial.cost < b.trial.cost;
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
  const double factor = best->trial.relative_standard_error / *settings.target_error;
  return pixels * best->trial_seconds * factor * factor;
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

// The method of a render that is too short for trials: the scene's, but bidir if that lacks caustics.
const Candidate& without_trials(const std::vector<Candidate>& candidates, const scene::Scene& scene) {
  const std::string own = scene.defaults.integrator;
  const std::string wanted = finds_caustics_by_chance(scene, own) ? "bidir" : own;
  const auto found =
      std::ranges::find(candidates, wanted, [](const Candidate& c) { return c.settings.integrator; });
  return found == candidates.end() ? candidates.front() : *found;
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

bool finds_caustics_by_chance(const scene::Scene& scene, const std::string& integrator) {
  return integrator == "path" && has_delta(scene) && !scene.area_emitters.empty();
}

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
  if (candidates.size() == 1)
    return {.texts = candidates.front().texts,
            .words = fmt::format("{}: no other method can render this scene with these options",
                                 method_of(settings))};
  if (share_for_trials * seconds_of_render(settings, pixels, {}) < first_seconds) {
    const Candidate& untried = without_trials(candidates, scene);
    return {.texts = untried.texts,
            .words = fmt::format("{}: the render is too short for trials", method_of(untried.settings))};
  }
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
  const std::vector<Candidate> integrators = candidates;
  correct_costs(candidates, scene);
  const Candidate best = *std::ranges::min_element(candidates, is_better);
  candidates = integrators;
  for (const auto& [name, text] : variants_of(best.settings.integrator, scene)) {
    Texts texts = best.texts;
    texts[name] = text;
    auto variant = choices.has(name) ? std::nullopt : trials.candidate(texts);
    if (!variant) continue;
    trials.run(*variant, std::max(samples_for(best), first_samples));
    if (variant->trial.refusal.empty()) candidates.push_back(*variant);
  }
  correct_costs(candidates, scene);
  for (Candidate& c : candidates) use_point_sets(c, samples_of_render(settings, pixels, c), trials, choices);
  std::ranges::sort(candidates, is_better);
  return {.texts = candidates.front().texts, .words = words_for(candidates)};
}

} // namespace phlux::advice
