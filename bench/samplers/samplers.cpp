#include "bench/samplers/samplers.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/common/enumeration.h"
#include "bench/common/methods/method.h"
#include "bench/common/methods/ranking.h"
#include "bench/common/methods/result_table.h"
#include "bench/common/methods/timed_render.h"
#include "bench/common/report/draw.h"
#include "bench/common/status_line.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/provenance.h"
#include "bench/scenes/scene_files.h"
#include "measure/moments.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

constexpr int most_samples = 1024, quick_most_samples = 256;
constexpr int least_samples = 16; // fewer are independent with every sampler
constexpr int step = 4;

const std::string& independent() {
  return settings::sampler_names()[static_cast<std::size_t>(settings::Sampler::independent)];
}

const std::string columns =
    "scene,integrator,sampler,samples_per_pixel,error,variance_per_sample,variance_standard_error,gain,"
    "gain_standard_error,ns_per_sample,time_ratio,relative_time,slope,slope_standard_error,rounds,image,seed,"
    "device";

render::Settings settings_of(const std::string& integrator, const std::string& sampler,
                             const scene::Scene& scene, const SamplersOptions& options) {
  const render::Settings defaults;
  const std::string variant = integrator == "bidir" ? "balance" : "mis";
  render::Settings settings = settings_of(Method{integrator, defaults.strategy, variant}, scene.defaults);
  settings.sampler = static_cast<settings::Sampler>(std::ranges::find(settings::sampler_names(), sampler) -
                                                    settings::sampler_names().begin());
  options.apply_to(settings);
  return settings;
}

struct Rounds { // of one sampler, with one number of samples
  std::vector<ImageEstimate> images;
  std::vector<double> seconds; // per sample
};

// In each round every sampler renders once, so that other programs affect all alike.
std::vector<Rounds> render(std::vector<std::unique_ptr<MethodRenderer>>& renderers, std::uint64_t first_seed,
                           int samples, CostClock clock, const SamplersOptions& options) {
  std::vector<Rounds> all(renderers.size());
  for (int round = 0; round < options.rounds(); ++round)
    for (std::size_t i = 0; i < renderers.size(); ++i) {
      const CountedRender one = renderers[i]->render_samples(first_seed + static_cast<std::uint64_t>(round),
                                                             samples, options.interrupted);
      const double seconds =
          clock == CostClock::processor ? one.processor_seconds : one.statistics.seconds_render;
      all[i].images.push_back(estimate_of(one.film));
      all[i].seconds.push_back(seconds / static_cast<double>(one.statistics.paths));
    }
  return all;
}

// All samplers by one integrator, the numbers of samples in ascending order. Each number has its own seeds,
// so that the errors from which the slope is fitted are independent.
std::vector<SamplerError> measure(const scene::Scene& scene, const std::string& name,
                                  const std::string& integrator, CostClock clock,
                                  const SamplersOptions& options,
                                  const std::function<void(int samples)>& report) {
  std::vector<std::unique_ptr<MethodRenderer>> renderers;
  for (const std::string& sampler : options.samplers)
    renderers.push_back(
        std::make_unique<MethodRenderer>(scene, settings_of(integrator, sampler, scene, options)));
  const std::vector<int> counts = sample_counts(options);
  std::vector<std::vector<Rounds>> rounds; // by number of samples, then by sampler
  std::uint64_t seed = options.seed;
  for (const int samples : counts) {
    report(samples);
    rounds.push_back(render(renderers, seed, samples, clock, options));
    seed += static_cast<std::uint64_t>(options.rounds());
  }
  std::vector<ImageEstimate> best;
  for (const Rounds& of_sampler : rounds.back())
    best.insert(best.end(), of_sampler.images.begin(), of_sampler.images.end());
  const Reference reference = pooled_reference(best, static_cast<std::size_t>(scene.camera.width));

  std::vector<std::vector<double>> independent_variances; // by number of samples
  std::vector<double> ratios(options.rounds());
  std::vector<SamplerError> errors;
  for (std::size_t i = 0; i < options.samplers.size(); ++i) {
    const std::vector<double>& seconds = rounds.back()[i].seconds;
    std::ranges::transform(seconds, rounds.back()[0].seconds, ratios.begin(), std::divides<>());
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const std::vector<double> variances = variances_per_sample(rounds[k][i].images, reference);
      if (i == 0) independent_variances.push_back(variances);
      errors.push_back({name, integrator, options.samplers[i], counts[k], mean_of(variances),
                        ratio_of(independent_variances[k], variances), 1e9 * measure::median(seconds),
                        measure::median(ratios)});
    }
  }
  return errors;
}

std::vector<SamplerError> those_of(const std::vector<SamplerError>& errors, const SamplerError& like) {
  std::vector<SamplerError> found;
  std::ranges::copy_if(errors, std::back_inserter(found), [&](const SamplerError& error) {
    return error.scene == like.scene && error.integrator == like.integrator && error.sampler == like.sampler;
  });
  return found;
}

std::string row_of(const SamplerError& e, const Estimate& slope, const scene::Camera& camera,
                   const SamplersOptions& options, const std::string& device) {
  std::vector<std::string> row = {csv_value(e.scene), e.integrator, e.sampler, fmt::format("{}", e.samples)};
  for (const double value : {std::sqrt(e.variance.value / e.samples), e.variance.value,
                             e.variance.standard_error, e.gain.value, e.gain.standard_error, e.ns,
                             e.time_ratio, e.relative_time().value, slope.value, slope.standard_error})
    row.push_back(number_text(value));
  row.push_back(fmt::format("{},{}x{},{},{}", options.rounds(), camera.width, camera.height, options.seed,
                            csv_value(device)));
  return fmt::format("{}", fmt::join(row, ","));
}

void print(const SamplerError& e, const Estimate& slope) {
  say("{:<18} {:<6} {:<12} variance {:>9.4g} +- {:.1g} at {} samples, gain {:.2f} +- {:.2f}, time {:.3f}, "
      "slope {:.3f} +- {:.3f}\n",
      e.scene, e.integrator, e.sampler, e.variance.value, e.variance.standard_error, e.samples, e.gain.value,
      e.gain.standard_error, e.time_ratio, slope.value, slope.standard_error);
}

std::string command_of(const SamplersOptions& options) {
  const SamplersOptions defaults;
  return options.command("samplers",
                         text_of_values("--integrator", options.integrators, defaults.integrators) +
                             text_of_values("--sampler", options.samplers, defaults.samplers));
}

std::string answer_for(const std::string& integrator, int samples, const std::vector<SamplerError>& errors) {
  std::map<std::string, std::vector<Estimate>> times; // by sampler, of all scenes
  for (const SamplerError& error : errors)
    if (error.integrator == integrator && error.samples == samples && error.sampler != independent())
      times[error.sampler].push_back(error.relative_time());
  std::vector<std::pair<std::string, Estimate>> means;
  for (const auto& [sampler, of_scenes] : times) means.emplace_back(sampler, mean_log_of(of_scenes));
  std::ranges::sort(means, {}, [](const auto& mean) { return mean.second.value; });
  std::vector<std::string> parts;
  for (const auto& [sampler, mean] : means)
    parts.push_back(fmt::format("--sampler {} needs {} times the time", sampler, text_of_mean_log(mean)));
  return fmt::format("{}: for the error of {} independent samples per pixel, {}", integrator, samples,
                     enumeration(parts));
}

} // namespace

std::vector<int> sample_counts(const SamplersOptions& options) {
  int samples = options.samples > 0 ? options.samples : options.quick ? quick_most_samples : most_samples;
  std::vector<int> counts = {samples};
  while ((samples /= step) >= least_samples) counts.push_back(samples);
  std::ranges::reverse(counts);
  return counts;
}

Estimate slope_of(const std::vector<SamplerError>& errors) {
  std::vector<double> x, y, se;
  for (const SamplerError& error : errors) {
    x.push_back(std::log(error.samples));
    y.push_back(0.5 * std::log(error.variance.value / error.samples)); // of the root mean square error
    se.push_back(0.5 * error.variance.standard_error / error.variance.value);
  }
  const double mean = mean_of(x).value;
  double squares = 0, products = 0, variance = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    squares += (x[i] - mean) * (x[i] - mean);
    products += (x[i] - mean) * y[i];
    variance += std::pow((x[i] - mean) * se[i], 2);
  }
  return {products / squares, std::sqrt(variance) / squares, errors.front().variance.degrees};
}

std::vector<std::string> sampler_answers(const std::vector<SamplerError>& errors) {
  int samples = 0;
  for (const SamplerError& error : errors) samples = std::max(samples, error.samples);
  std::vector<std::string> answers, seen;
  for (const SamplerError& error : errors) {
    if (std::ranges::count(seen, error.integrator) > 0) continue;
    seen.push_back(error.integrator);
    answers.push_back(answer_for(error.integrator, samples, errors));
  }
  return answers;
}

bool measure_samplers(const SamplersOptions& given) try {
  SamplersOptions options = given;
  std::erase(options.samplers, independent());
  options.samplers.insert(options.samplers.begin(), independent());
  const device::DeviceInfo device = device::open_devices(options.devices).front().info;
  const std::vector<std::filesystem::path> files = options.scenes.empty() ? shipped_scenes() : options.scenes;
  check_scenes(files);
  CsvFile table(options.folder, "samplers.csv", columns);
  StatusLine status;
  std::vector<SamplerError> all;
  for (const auto& file : files) {
    const std::string name = file.stem().string();
    const scene::Scene scene = load_at_size(file, options.side());
    for (const std::string& integrator : options.integrators) {
      const std::vector<SamplerError> errors =
          measure(scene, name, integrator, clock_of(device), options, [&](int samples) {
            status.show(fmt::format("{}, {}: {} samples per pixel", name, integrator, samples));
          });
      status.clear();
      for (const SamplerError& error : errors) {
        const Estimate slope = slope_of(those_of(errors, error));
        table.line(row_of(error, slope, scene.camera, options, device.name));
        if (error.samples == errors.back().samples) print(error, slope);
        all.push_back(error);
      }
    }
  }
  const int seeds = options.rounds() * static_cast<int>(sample_counts(options).size());
  write_provenance(options.folder, "samplers",
                   {command_of(given), device, options.lanes_on(device),
                    "kernels are built before the rounds", options.seeds(seeds)});
  report_answers(options.folder, "samplers", sampler_answers(all));
  return true;
} catch (const Interrupted&) {
  say("interrupted: {} contains the finished rows\n", (given.folder / "samplers.csv").string());
  return false;
}

} // namespace phlux::bench
