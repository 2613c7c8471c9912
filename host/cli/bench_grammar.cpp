// The grammar of `phlux bench`.
#include <algorithm>
#include <limits>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/arithmetic/arithmetic.h"
#include "bench/common/methods/timed_render.h"
#include "bench/figures/figures.h"
#include "bench/precision/precision.h"
#include "bench/rays/rays.h"
#include "bench/remedies/remedies.h"
#include "bench/roulette/roulette.h"
#include "bench/samplers/samplers.h"
#include "bench/sampling/sampling.h"
#include "bench/scenes/scenes.h"
#include "bench/stability/stability.h"
#include "bench/stability/stability_scene.h"
#include "bench/techniques/techniques.h"
#include "cli/bench_model.h"
#include "cli/grammar.h"
#include "cli/interrupt.h"
#include "errors.h"
#include "printable.h"
#include "settings/strategies.h"
#include "settings/values.h"
#include "terminal.h"

namespace phlux::cli {
namespace {

const char* const default_folder = "bench-results";

void add_common(CLI::App& app, bench::CommonOptions& options) {
  options.folder = default_folder;
  add_value(app, "--out", "DIR",
            fmt::format("folder for tables, charts and the report; created if missing; default: {}",
                        default_folder),
            [&options](const std::string& text) {
              if (text.empty()) throw UsageError("--out '': must be the name of a folder");
              options.folder = text;
            });
  add_one_device(app, options.devices, options.lanes, options.kernel_dir);
}

template<class Seed>
void add_seed(CLI::App& app, const std::string& of, Seed& seed) {
  add_value(app, "--seed", "N", "seed of " + of + "; default: 1", [&seed](const std::string& text) {
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    seed = static_cast<Seed>(settings::whole_number("--seed", text, 0, most));
  });
}

void add_scene_files(CLI::App& app, const std::string& defaults, std::vector<std::filesystem::path>& files) {
  add_values(app, "--scene", "FILE.xml", "measure only this scene; may be repeated; default: " + defaults,
             [&files](const std::string& text) { files.emplace_back(text); });
}

// An option that may be repeated, whose names replace the default ones.
void add_names(CLI::App& app, const std::string& option, const std::string& help,
               const std::vector<std::string>& names, std::vector<std::string>& chosen) {
  const auto named = std::make_shared<bool>(false);
  add_values(app, option, "NAME",
             fmt::format("{}; may be repeated; default: {}", help, fmt::join(chosen, ", ")),
             [&chosen, &names, option, named](const std::string& text) {
               if (!*named) chosen.clear();
               *named = true;
               chosen.push_back(names[settings::choice(option, text, names)]);
             });
}

void add_strategies(CLI::App& app, std::vector<std::string>& strategies) {
  add_names(app, "--strategy", "directional sampling strategy", render::strategy_names(), strategies);
}

// Scenes, amount and seed of a measurement by rounds.
void add_rounds(CLI::App& app, bench::RoundOptions& options, const std::string& default_scenes,
                const std::string& samples) {
  add_scene_files(app, default_scenes, options.scenes);
  add_value(app, "--samples", "N", samples, [&options](const std::string& text) {
    constexpr std::uint64_t most = 1'000'000;
    options.samples = static_cast<int>(settings::whole_number("--samples", text, 1, most));
  });
  add_flag(app, "--quick", "smaller images, fewer samples and rounds", options.quick);
  add_seed(app, "the first round", options.seed);
}

constexpr const char* samples_per_round = "samples per pixel and round; default: 64, or 16 with --quick";

// Render time and image size.
void add_amount(CLI::App& app, bench::ComparisonOptions& options, const std::string& seconds,
                const std::string& side) {
  add_value(app, "--seconds", "S", seconds, [&options](const std::string& text) {
    options.seconds = settings::number_within("--seconds", text, 1e-6, 1e9);
  });
  add_value(app, "--side", "N", side, [&options](const std::string& text) {
    constexpr std::uint64_t most = 4096;
    options.side = static_cast<int>(settings::whole_number("--side", text, 1, most));
  });
  add_seed(app, "the first round", options.seed);
  app.footer(
      "Results in the folder that have the same settings are kept, so that an interrupted run resumes.");
}

template<class Options>
void measure_by(void (*measure)(const Options&), CLI::App& app, std::optional<Command>& command,
                const std::shared_ptr<Options>& options) {
  app.final_callback([=, &command] {
    command = [=] {
      measure(*options);
      return 0;
    };
  });
}

// For a measurement that can be interrupted: it returns whether it was completed.
template<class Options>
void measure_by(bool (*measure)(const Options&), CLI::App& app, std::optional<Command>& command,
                const std::shared_ptr<Options>& options) {
  app.final_callback([=, &command] {
    command = [=] {
      const InterruptGuard guard;
      options->interrupted = [&guard] { return guard.requested(); };
      bool complete = false;
      if (!bench::runs_to_end([&] { complete = measure(*options); }, options->interrupted))
        say("interrupted: {} contains what was finished\n", printable(options->folder.string()));
      return complete ? 0 : interrupted_exit_code;
    };
  });
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  if (text.empty() || text.ends_with(',')) parts.emplace_back();
  return parts;
}

void add_rays(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app =
      *bench.add_subcommand("rays", "Compares ray traversal with Embree on the same rays: rays.csv");
  const auto options = std::make_shared<bench::RaysOptions>();
  add_common(app, *options);
  add_value(app, "--triangles", "N,N,...", "numbers of triangles; default: 36,20000,500000",
            [options](const std::string& text) {
              constexpr std::uint64_t least = 36, most = 50'000'000;
              options->triangles.clear();
              for (const std::string& part : split(text))
                options->triangles.push_back(settings::whole_number("--triangles", part, least, most));
            });
  add_traversal(app, options->traversal);
  measure_by(bench::measure_rays, app, command, options);
}

bench::Case case_of(const std::string& text) {
  const std::vector<std::string> parts = split(text);
  if (parts.size() != 4) throw UsageError(fmt::format("--case {}: must be KD,KS,N,DEGREES", text));
  const auto number = [&](std::size_t i, double most) {
    return settings::number_within("--case", parts[i], 0, most);
  };
  constexpr double largest_exponent = 1e6, largest_angle = 89.999;
  const bench::Case one{number(0, 1), number(1, 1), number(2, largest_exponent), number(3, largest_angle)};
  if (one.diffuse + one.specular > 1 || one.specular == 0)
    throw UsageError(fmt::format("--case {}: KD + KS must be at most 1, and KS above 0", text));
  return one;
}

bool measure_each_model(const bench::SamplingOptions& options) {
  if (options.materials.empty()) return bench::measure_sampling(options);
  return std::ranges::all_of(options.materials, [&](const auto& material) {
    bench::SamplingOptions one = options;
    one.material = material;
    return bench::measure_sampling(one);
  });
}

void add_sampling(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "sampling", "Measures every sampling strategy of the Phong model without a scene: sampling.csv");
  const auto options = std::make_shared<bench::SamplingOptions>();
  add_common(app, *options);
  add_flag(app, "--quick", "13 materials and angles, with 2^18 samples per row of the table", options->quick);
  add_flag(app, "--fresh", "measures everything again instead of resuming an earlier run", options->fresh);
  add_value(app, "--samples", "N", "samples per row of the table; default: 2^19, or 2^18 with --quick",
            [options](const std::string& text) {
              constexpr std::uint64_t most = 1'000'000'000'000;
              options->samples = settings::whole_number("--samples", text, 1, most);
            });
  add_values(
      app, "--strategy", "NAME|FILE.cl",
      "only this strategy, or a kernel file with one of your own; may be repeated; default: all that ship",
      [options](const std::string& text) {
        const std::string strategy = settings::strategy("--strategy", text);
        if (settings::is_strategy_file(strategy)) {
          static_cast<void>(settings::read_strategy(strategy));
          if (strategy.find(',') != std::string::npos)
            throw UsageError(
                fmt::format("--strategy {}: is written to tables with commas: give the file a name "
                            "without one",
                            strategy));
        }
        if (std::ranges::count(options->strategies, strategy) == 0) options->strategies.push_back(strategy);
      });
  add_values(
      app, "--case", "KD,KS,N,DEGREES",
      "only this Phong material (kd, ks and exponent n) and angle of incidence; may be repeated; default: a "
      "grid of materials and angles",
      [options](const std::string& text) { options->cases.push_back(case_of(text)); });
  add_values(app, "--integrand", "NAME",
             "only this incident light: constant, mirror-disk (a bright disk about the mirror direction) or "
             "horizon-sky (a sky that is bright at the horizon); may be repeated; default: all",
             [options](const std::string& text) {
               options->lights.push_back(
                   static_cast<bench::Light>(settings::choice("--integrand", text, bench::light_names())));
             });
  add_value(
      app, "--ray-cost", "NS",
      "time of a ray in nanoseconds, which is added to the time of the sampler when strategies are ranked; "
      "default: the time of 20 samples by lobe-ks, about that of a ray through half a million triangles",
      [options](const std::string& text) {
        constexpr double most = 1e6;
        options->ray_ns = settings::number_within("--ray-cost", text, 0, most);
      });
  add_bench_model(app, options);
  add_seed(app, "the random numbers", options->seed);
  measure_by(measure_each_model, app, command, options);
}

void add_arithmetic(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "arithmetic", "Measures error and speed of formulas for the kernels: arithmetic.csv");
  const auto options = std::make_shared<bench::ArithmeticOptions>();
  add_common(app, *options);
  add_flag(app, "--quick", "2^15 instead of 2^18 values per formula; shorter timings", options->quick);
  measure_by(bench::measure_arithmetic, app, command, options);
}

void add_precision(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app =
      *bench.add_subcommand("precision", "Compares error and speed of float32 and float64: precision.csv");
  const auto options = std::make_shared<bench::PrecisionOptions>();
  add_common(app, *options);
  add_scene_files(app, "scenes/*.xml and scenes/stability/*.xml", options->scenes);
  add_flag(app, "--quick", "only path tracing, without scenes/stability; fewer samples", options->quick);
  app.footer("float32 is measured with WIDTH 1 and with that of --width. The device must support doubles.");
  measure_by(bench::measure_precision, app, command, options);
}

void add_remedies(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "remedies", "Measures the gain of techniques that reduce variance without bias: remedies.csv");
  const auto options = std::make_shared<bench::RemediesOptions>();
  add_common(app, *options);
  add_values(app, "--remedy", "NAME",
             fmt::format("only this remedy, one of {}; may be repeated; default: all",
                         fmt::join(bench::remedy_names(), ", ")),
             [options](const std::string& text) {
               const auto& names = bench::remedy_names();
               options->remedies.push_back(names[settings::choice("--remedy", text, names)]);
             });
  add_flag(app, "--quick", "fewer and easier scenes; shorter renders", options->quick);
  measure_by(bench::measure_remedies, app, command, options);
}

void add_roulette(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "roulette", "Measures variance x rays of renders with each Russian roulette: roulette.csv");
  const auto options = std::make_shared<bench::RouletteOptions>();
  add_common(app, *options);
  add_names(app, "--integrator", "integrator", settings::integrator_names(), options->integrators);
  add_names(app, "--roulette", "survival probability, measured from edge 1 and from edge 5",
            render::roulette_names(), options->roulettes);
  add_strategies(app, options->strategies);
  add_rounds(app, *options, "scenes/*.xml, without the furnaces", samples_per_round);
  measure_by(bench::measure_roulette, app, command, options);
}

void add_samplers(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "samplers", "Measures error and time with low-discrepancy and independent samples: samplers.csv");
  static const std::vector<std::string> integrators = {"path", "bidir"}; // light has independent samples only
  const auto options = std::make_shared<bench::SamplersOptions>();
  add_common(app, *options);
  add_names(app, "--integrator", "integrator", integrators, options->integrators);
  add_names(app, "--sampler", "compared with independent samples", settings::sampler_names(),
            options->samplers);
  add_rounds(
      app, *options, "scenes/*.xml",
      "largest number of samples per pixel; also measured are a quarter of it, and so on, four numbers "
      "in all; default: 1024, or 256 with --quick");
  measure_by(bench::measure_samplers, app, command, options);
}

void add_techniques(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "techniques",
      "Measures the share of each technique (s, t) in light, variance and rays: techniques.csv");
  const auto options = std::make_shared<bench::TechniquesOptions>();
  add_common(app, *options);
  add_value(app, "--integrator", "NAME", "bidir or light; default: bidir",
            [options](const std::string& text) {
              const std::vector<std::string> names = {"bidir", "light"};
              options->integrator = names[settings::choice("--integrator", text, names)];
            });
  add_value(app, "--weights", "NAME", "of bidir: balance, power or uniform; default: balance",
            [options](const std::string& text) {
              const auto& names = render::weights_names();
              options->weights = names[settings::choice("--weights", text, names)];
            });
  add_rounds(app, *options, "scenes/*.xml", samples_per_round);
  measure_by(bench::measure_techniques, app, command, options);
}

void add_figures(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "figures", "Draws the figures of CW 197 from the output of the kernels: figure-1 to figure-7");
  const auto options = std::make_shared<bench::FiguresOptions>();
  add_common(app, *options);
  app.footer("Figures are .csv, .svg and .png. They need python3-matplotlib; without it only the tables are "
             "written,\n"
             "and the exit code is 5.");
  measure_by(bench::make_figures, app, command, options);
}

void add_scenes(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "scenes", "Measures variance and time of every method on every scene: scenes.csv");
  const auto options = std::make_shared<bench::ScenesOptions>();
  options->build_ahead = true;
  add_common(app, *options);
  add_scene_files(app, "scenes/*.xml", options->scenes);
  add_strategies(app, options->strategies);
  add_flag(app, "--quick", "less time per scene: under two minutes for scenes/*.xml", options->quick);
  add_amount(app, *options,
             "seconds per scene; default: 120, or 11 with --quick; less if there are many scenes",
             "largest side of the images in pixels; default: 128, or 64 with --quick");
  measure_by(bench::measure_scenes, app, command, options);
}

bench::StabilityCell cell_of(const std::string& text) {
  const std::vector<std::string> parts = split(text);
  if (parts.size() != 2) throw UsageError(fmt::format("--cell {}: must be N,RADIUS", text));
  constexpr double largest_exponent = 1e6, least_radius = 1e-4;
  return {settings::number_within("--cell", parts[0], 0, largest_exponent),
          settings::number_within("--cell", parts[1], least_radius, bench::largest_light_radius)};
}

void add_stability(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "stability",
      "Measures where each method fails, by exponent of a lobe and size of a light: stability.csv");
  const auto options = std::make_shared<bench::StabilityOptions>();
  options->build_ahead = true;
  add_common(app, *options);
  add_flag(app, "--quick", "nine cells and five methods in under two minutes; smaller images",
           options->quick);
  add_values(app, "--cell", "N,RADIUS",
             "only this exponent of the lobe and radius of the light; may be repeated; default: a grid",
             [options](const std::string& text) { options->cells.push_back(cell_of(text)); });
  add_values(app, "--method", "NAME",
             "only this method, such as 'path mis' or light; may be repeated; default: all",
             [options](const std::string& text) {
               const auto names = bench::stability_method_names();
               options->variants.push_back(names[settings::choice("--method", text, names)]);
             });
  add_strategies(app, options->strategies);
  add_amount(app, *options,
             "seconds per cell; default: 20, or 10 with --quick; less if building kernels takes long",
             "side of the images in pixels; default: 48, or 32 with --quick");
  measure_by(bench::measure_stability, app, command, options);
}

} // namespace

void add_bench(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("bench", "Measures this device: tables (CSV), charts and a report");
  app.require_subcommand(1);
  app.footer("phlux bench COMMAND --help lists the options of a command.");
  add_scenes(app, command);
  add_rays(app, command);
  add_sampling(app, command);
  add_arithmetic(app, command);
  add_precision(app, command);
  add_remedies(app, command);
  add_roulette(app, command);
  add_samplers(app, command);
  add_techniques(app, command);
  add_figures(app, command);
  add_stability(app, command);
}

} // namespace phlux::cli
