#include "bench/roulette/roulette.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/common/enumeration.h"
#include "bench/common/methods/result_table.h"
#include "bench/common/methods/timed_render.h"
#include "bench/common/report/draw.h"
#include "bench/common/status_line.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/provenance.h"
#include "bench/scenes/scene_files.h"
#include "measure/statistics.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

constexpr int longest = 64; // edges of a path: without roulette nothing else ends it
constexpr double false_alarm_rate = 0.05;

const std::string columns =
    "scene,integrator,strategy,roulette,rr_depth,variance,variance_standard_error,rays_per_sample,"
    "variance_times_rays,ratio,ratio_standard_error,rounds,samples_per_pixel,image,seed,device";

std::string name_of(render::Roulette roulette) {
  return render::roulette_names()[static_cast<std::size_t>(roulette)];
}

// In a furnace roulette is nearly all of the noise, which no room has.
std::vector<std::filesystem::path> scenes_of(const RouletteOptions& options) {
  if (!options.scenes.empty()) return options.scenes;
  std::vector<std::filesystem::path> files = shipped_scenes();
  std::erase_if(files, [](const auto& file) { return file.stem().string().starts_with("furnace"); });
  return files;
}

render::Settings settings_of(const RouletteVariant& variant, const std::string& integrator,
                             const scene::Scene& scene, const RouletteOptions& options) {
  render::Settings settings;
  settings.integrator = integrator;
  settings.strategy = variant.strategy;
  settings.roulette = variant.roulette;
  settings.rr_depth = variant.rr_depth;
  settings.max_depth = scene.defaults.max_depth < 0 ? longest : scene.defaults.max_depth;
  options.apply_to(settings);
  return settings;
}

struct Renders { // of one variant
  std::vector<ImageEstimate> images;
  std::vector<double> rays; // per sample
};

Renders render(const scene::Scene& scene, const render::Settings& settings, const RouletteOptions& options) {
  MethodRenderer renderer(scene, settings);
  Renders renders;
  for (int round = 0; round < options.rounds(); ++round) {
    const CountedRender one = renderer.render_samples(options.seed + static_cast<std::uint64_t>(round),
                                                      options.round_samples(), options.interrupted);
    renders.images.push_back(estimate_of(one.film));
    renders.rays.push_back(one.rays_per_sample());
  }
  return renders;
}

std::vector<double> product(std::vector<double> a, const std::vector<double>& b) {
  std::ranges::transform(a, b, a.begin(), std::multiplies<>());
  return a;
}

// All variants by one integrator, without those that the renderer refuses. Their renders have the same seeds,
// so that rounds are paired.
std::vector<RouletteCost> measure(const scene::Scene& scene, const std::string& name,
                                  const std::string& integrator, const Reference& reference,
                                  const RouletteOptions& options,
                                  const std::function<void(const RouletteVariant&)>& report,
                                  const std::function<void(const std::string&)>& notice) {
  std::vector<RouletteCost> costs;
  std::vector<double> first; // costs of the first variant
  for (const RouletteVariant& variant : roulette_variants(options)) {
    report(variant);
    Renders renders;
    try {
      renders = render(scene, settings_of(variant, integrator, scene, options), options);
    } catch (const UsageError& error) {
      notice(fmt::format("{} {}: refused: {}", integrator, variant.options(), error.what()));
      continue;
    }
    const std::vector<double> variances = variances_per_sample(renders.images, reference);
    const std::vector<double> products = product(variances, renders.rays);
    if (first.empty()) first = products;
    costs.push_back({name, integrator, variant, mean_of(variances), mean_of(products),
                     ratio_of(products, first), mean_of(renders.rays).value});
  }
  return costs;
}

// The weights of the errors, from as many renders as one variant has: those of bidir, which has a technique
// for all light.
Reference reference_of(const scene::Scene& scene, const RouletteOptions& options) {
  const Renders renders = render(scene, settings_of({}, "bidir", scene, options), options);
  return pooled_reference(renders.images, static_cast<std::size_t>(scene.camera.width));
}

std::string row_of(const RouletteCost& c, const scene::Camera& camera, const RouletteOptions& options,
                   const std::string& device) {
  std::vector<std::string> row = {csv_value(c.scene), c.integrator, c.variant.strategy,
                                  c.variant.rr_depth < 0 ? "none" : name_of(c.variant.roulette),
                                  fmt::format("{}", c.variant.rr_depth)};
  for (const double value : {c.variance.value, c.variance.standard_error, c.rays_per_sample, c.cost.value,
                             c.ratio.value, c.ratio.standard_error})
    row.push_back(number_text(value));
  row.push_back(fmt::format("{},{},{}x{},{}", options.rounds(), options.round_samples(), camera.width,
                            camera.height, options.seed));
  row.push_back(csv_value(device));
  return fmt::format("{}", fmt::join(row, ","));
}

std::string command_of(const RouletteOptions& options) {
  const RouletteOptions defaults;
  return options.command("roulette",
                         text_of_values("--integrator", options.integrators, defaults.integrators) +
                             text_of_values("--strategy", options.strategies, defaults.strategies) +
                             text_of_values("--roulette", options.roulettes, defaults.roulettes));
}

// The ratios of a variant on all scenes.
std::vector<Estimate> ratios_of(const std::vector<RouletteCost>& costs, const std::string& integrator,
                                const RouletteVariant& variant) {
  std::vector<Estimate> ratios;
  for (const RouletteCost& cost : costs)
    if (cost.integrator == integrator && cost.variant == variant) ratios.push_back(cost.ratio);
  return ratios;
}

std::string answer_for(const std::string& integrator, const std::vector<RouletteCost>& costs) {
  const std::size_t scenes = ratios_of(costs, integrator, {}).size();
  std::vector<std::pair<RouletteVariant, Estimate>> means;
  for (const RouletteCost& cost : costs)
    if (cost.integrator == integrator && cost.scene == costs.front().scene)
      if (const auto ratios = ratios_of(costs, integrator, cost.variant); ratios.size() == scenes)
        means.emplace_back(cost.variant, mean_log_of(ratios));
  std::ranges::sort(means, {}, [](const auto& mean) { return mean.second.value; });
  const Estimate& best = means.front().second;
  const double level = measure::sidak_limit(false_alarm_rate, means.size() - 1);
  std::vector<std::string> tied;
  for (std::size_t i = 1; i < means.size(); ++i)
    if (p_value(difference_of(means[i].second, best), 0) > level)
      tied.push_back(fmt::format("{} ({:.3f})", means[i].first.options(), std::exp(means[i].second.value)));
  return fmt::format("{}: {} needs {} times the rays of {} for the same error{}{}", integrator,
                     means.front().first.options(), text_of_mean_log(best), RouletteVariant().options(),
                     tied.empty() ? "" : "; tied with ", enumeration(tied));
}

void print(const RouletteCost& c) {
  say("{:<18} {:<6} {:<44} variance {:>9.4g} +- {:.1g}, {:>6.4g} rays, product {:>9.4g}: {:.3f} +- {:.3f}\n",
      c.scene, c.integrator, c.variant.options(), c.variance.value, c.variance.standard_error,
      c.rays_per_sample, c.cost.value, c.ratio.value, c.ratio.standard_error);
}

} // namespace

std::string RouletteVariant::options() const {
  const std::string of_strategy =
      strategy == render::Settings().strategy ? "" : fmt::format("--strategy {} ", strategy);
  if (rr_depth < 0) return of_strategy + "--rr-depth -1";
  return fmt::format("{}--roulette {} --rr-depth {}", of_strategy, name_of(roulette), rr_depth);
}

std::vector<RouletteVariant> roulette_variants(const RouletteOptions& options) {
  std::vector<RouletteVariant> variants = {RouletteVariant{}};
  const auto add = [&](const RouletteVariant& variant) {
    if (std::ranges::count(variants, variant) == 0) variants.push_back(variant);
  };
  for (const std::string& strategy : options.strategies) {
    for (const int rr_depth : {1, 5})
      for (const std::string& roulette : options.roulettes)
        add({strategy,
             static_cast<render::Roulette>(std::ranges::find(render::roulette_names(), roulette) -
                                           render::roulette_names().begin()),
             rr_depth});
    add({strategy, render::Settings().roulette, -1});
  }
  return variants;
}

std::vector<std::string> roulette_answers(const std::vector<RouletteCost>& costs) {
  std::vector<std::string> answers, seen;
  for (const RouletteCost& cost : costs) {
    if (std::ranges::count(seen, cost.integrator) > 0) continue;
    seen.push_back(cost.integrator);
    answers.push_back(answer_for(cost.integrator, costs));
  }
  return answers;
}

bool measure_roulette(const RouletteOptions& options) try {
  const device::DeviceInfo device = device::open_devices(options.devices).front().info;
  const std::vector<std::filesystem::path> files = scenes_of(options);
  check_scenes(files);
  CsvFile table(options.folder, "roulette.csv", columns);
  StatusLine status;
  std::vector<RouletteCost> all;
  for (const auto& file : files) {
    const std::string name = file.stem().string();
    const scene::Scene scene = load_at_size(file, options.side());
    const Reference reference = reference_of(scene, options);
    for (const std::string& integrator : options.integrators) {
      const auto report = [&](const RouletteVariant& variant) {
        status.show(fmt::format("{}, {} {}", name, integrator, variant.options()));
      };
      const auto notice = [&](const std::string& text) {
        status.clear();
        say("{}: {}\n", name, text);
      };
      for (const RouletteCost& cost : measure(scene, name, integrator, reference, options, report, notice)) {
        status.clear();
        table.line(row_of(cost, scene.camera, options, device.name));
        print(cost);
        all.push_back(cost);
      }
    }
  }
  write_provenance(options.folder, "roulette",
                   {command_of(options), device, options.lanes_on(device),
                    "nothing is timed: rays are counted", options.seeds(options.rounds())});
  report_answers(options.folder, "roulette", roulette_answers(all));
  return true;
} catch (const Interrupted&) {
  say("interrupted: {} contains the finished rows\n", (options.folder / "roulette.csv").string());
  return false;
}

} // namespace phlux::bench
