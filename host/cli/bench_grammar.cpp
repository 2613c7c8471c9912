// The grammar of `phlux bench`.
#include <limits>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/arithmetic/arithmetic.h"
#include "bench/figures/figures.h"
#include "bench/precision/precision.h"
#include "bench/rays/rays.h"
#include "bench/remedies/remedies.h"
#include "bench/sampling/sampling.h"
#include "bench/scenes/scenes.h"
#include "bench/stability/stability.h"
#include "bench/stability/stability_scene.h"
#include "cli/grammar.h"
#include "cli/interrupt.h"
#include "errors.h"
#include "settings/values.h"

namespace phlux::cli {
namespace {

const char* const default_folder = "bench-results";

void add_common(CLI::App& app, bench::CommonOptions& options) {
  options.folder = default_folder;
  add_value(
      app, "--out", "DIR",
      fmt::format("the folder that the tables go to, made where it is missing; default: {}", default_folder),
      [&options](const std::string& text) {
        if (text.empty()) throw UsageError("--out '': must be a folder's name");
        options.folder = text;
      });
  add_one_device(app, options.devices, options.lanes, options.kernel_dir);
}

template<class Seed>
void add_seed(CLI::App& app, const std::string& of, Seed& seed) {
  add_value(app, "--seed", "N", "of " + of + "; default: 1", [&seed](const std::string& text) {
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    seed = static_cast<Seed>(settings::whole_number("--seed", text, 0, most));
  });
}

void add_scene_files(CLI::App& app, const std::string& defaults, std::vector<std::filesystem::path>& files) {
  add_values(app, "--scene", "FILE.xml", "only this one; may be repeated; default: " + defaults,
             [&files](const std::string& text) { files.emplace_back(text); });
}

// In place of those that are there.
void add_strategies(CLI::App& app, std::vector<std::string>& strategies) {
  const auto named = std::make_shared<bool>(false);
  add_values(app, "--strategy", "NAME", "how directions are sampled; may be repeated; default: exact",
             [&strategies, named](const std::string& text) {
               const auto& names = render::strategy_names();
               if (!*named) strategies.clear();
               *named = true;
               strategies.push_back(names[settings::choice("--strategy", text, names)]);
             });
}

// How long methods are compared, and on how large images.
void add_amount(CLI::App& app, bench::ComparisonOptions& options, const std::string& seconds,
                const std::string& side) {
  add_value(app, "--seconds", "S", seconds, [&options](const std::string& text) {
    options.seconds = settings::positive_number("--seconds", text);
  });
  add_value(app, "--side", "N", side, [&options](const std::string& text) {
    constexpr std::uint64_t most = 4096;
    options.side = static_cast<int>(settings::whole_number("--side", text, 1, most));
  });
  add_seed(app, "the first round", options.seed);
  app.footer("What the folder holds of the same settings is not measured again: an interrupted run goes on.");
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

// For a measurement that says whether it came to its end, and that an interrupt ends.
template<class Options>
void measure_by(bool (*measure)(const Options&), CLI::App& app, std::optional<Command>& command,
                const std::shared_ptr<Options>& options) {
  app.final_callback([=, &command] {
    command = [=] {
      const InterruptGuard guard;
      options->interrupted = [&guard] { return guard.requested(); };
      return measure(*options) ? 0 : interrupted_exit_code;
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
  CLI::App& app = *bench.add_subcommand("rays", "Traversal against Embree's on the same rays: rays.csv");
  const auto options = std::make_shared<bench::RaysOptions>();
  add_common(app, *options);
  add_value(app, "--triangles", "N,N,...", "sizes of the mesh; default: 36,20000,500000",
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

void add_sampling(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "sampling",
      "Mean, variance, rays and time of a sample by every strategy: sampling.csv, sampling-no-roulette.csv");
  const auto options = std::make_shared<bench::SamplingOptions>();
  add_common(app, *options);
  app.add_flag("--quick", options->quick, "thirteen cases with a quarter of a million samples each");
  app.add_flag("--fresh", options->fresh,
               "begins anew where an earlier run with the same settings would go on");
  add_value(app, "--samples", "N", "samples for each row; default: half a million, or a quarter with --quick",
            [options](const std::string& text) {
              constexpr std::uint64_t most = 1'000'000'000'000;
              options->samples = settings::whole_number("--samples", text, 1, most);
            });
  add_values(app, "--strategy", "NAME", "only this one; may be repeated", [options](const std::string& text) {
    options->strategies.push_back(
        render::strategy_names()[settings::choice("--strategy", text, render::strategy_names())]);
  });
  add_values(app, "--case", "KD,KS,N,DEGREES",
             "only this material and angle of incidence; may be repeated; default: a grid",
             [options](const std::string& text) { options->cases.push_back(case_of(text)); });
  add_values(app, "--integrand", "NAME",
             "only this light: constant, mirror-disk (a bright disk about the mirror direction) or "
             "horizon-sky (a sky "
             "that is bright at the horizon); may be repeated",
             [options](const std::string& text) {
               options->lights.push_back(
                   static_cast<bench::Light>(settings::choice("--integrand", text, bench::light_names())));
             });
  add_seed(app, "the random numbers", options->seed);
  measure_by(bench::measure_sampling, app, command, options);
}

void add_arithmetic(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "arithmetic", "Accuracy against speed of the formulas that kernels could use: arithmetic.csv");
  const auto options = std::make_shared<bench::ArithmeticOptions>();
  add_common(app, *options);
  app.add_flag("--quick", options->quick, "fewer values");
  measure_by(bench::measure_arithmetic, app, command, options);
}

void add_precision(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "precision", "Float32 against float64: its error against noise, and its speed: precision.csv");
  const auto options = std::make_shared<bench::PrecisionOptions>();
  add_common(app, *options);
  add_scene_files(app, "those that ship, with those of scenes/stability", options->scenes);
  app.add_flag("--quick", options->quick, "path tracing alone, without scenes/stability; fewer samples");
  app.footer("--width N is measured beside 1. The device must have doubles.");
  measure_by(bench::measure_precision, app, command, options);
}

void add_remedies(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "remedies", "What lessens variance without a bias, each before and after: remedies.csv");
  const auto options = std::make_shared<bench::RemediesOptions>();
  add_common(app, *options);
  add_values(app, "--remedy", "NAME",
             fmt::format("only this one of {}; may be repeated; default: all",
                         fmt::join(bench::remedy_names(), ", ")),
             [options](const std::string& text) {
               const auto& names = bench::remedy_names();
               options->remedies.push_back(names[settings::choice("--remedy", text, names)]);
             });
  app.add_flag("--quick", options->quick, "fewer and easier places; shorter renders");
  measure_by(bench::measure_remedies, app, command, options);
}

void add_figures(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "figures", "The figures of CW 197 from the kernels' output: figure-1 to figure-7 (.csv, .svg, .png)");
  const auto options = std::make_shared<bench::FiguresOptions>();
  add_common(app, *options);
  app.footer(
      "The drawings need python3-matplotlib; without it the tables are written and the exit code is 5.");
  measure_by(bench::make_figures, app, command, options);
}

void add_scenes(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand(
      "scenes", "Every method on every scene: variance, time, convergence: scenes.csv and index.html");
  const auto options = std::make_shared<bench::ScenesOptions>();
  options->build_ahead = true;
  add_common(app, *options);
  add_scene_files(app, "those that ship", options->scenes);
  add_strategies(app, options->strategies);
  app.add_flag("--quick", options->quick, "under two minutes for the scenes that ship; coarser");
  add_amount(app, *options, "for each scene; default: 120, or 11 with --quick, less for many scenes",
             "pixels of an image's longer side at most; default: 128, or 64 with --quick");
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
      "stability", "Where each method fails, over a lobe's exponent and a light's size: stability.csv");
  const auto options = std::make_shared<bench::StabilityOptions>();
  options->build_ahead = true;
  add_common(app, *options);
  app.add_flag("--quick", options->quick, "nine cells and five methods in under two minutes; coarser");
  add_values(app, "--cell", "N,RADIUS",
             "only this exponent and radius of the light; may be repeated; default: a grid",
             [options](const std::string& text) { options->cells.push_back(cell_of(text)); });
  add_values(app, "--method", "NAME",
             "only this one, such as 'path mis' or light; may be repeated; default: all",
             [options](const std::string& text) {
               const auto names = bench::stability_method_names();
               options->variants.push_back(names[settings::choice("--method", text, names)]);
             });
  add_strategies(app, options->strategies);
  add_amount(app, *options,
             "for each cell; default: 20, or 10 with --quick, less where building kernels took long",
             "pixels of an image's side; default: 48, or 32 with --quick");
  measure_by(bench::measure_stability, app, command, options);
}

} // namespace

void add_bench(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("bench", "Measures this device: tables (CSV) and figures");
  app.require_subcommand(1);
  app.footer("phlux bench COMMAND --help lists the options of one.");
  add_scenes(app, command);
  add_rays(app, command);
  add_sampling(app, command);
  add_arithmetic(app, command);
  add_precision(app, command);
  add_remedies(app, command);
  add_figures(app, command);
  add_stability(app, command);
}

} // namespace phlux::cli
