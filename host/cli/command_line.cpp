#include "cli/command_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/checkpoints.h"
#include "cli/commands.h"
#include "cli/grammar.h"
#include "cli/version.h"
#include "errors.h"
#include "files/compare.h"
#include "settings/values.h"

namespace phlux::cli {
namespace {

using settings::Affects;

void add_settings(CLI::App& app, RenderOptions& options, const std::function<bool(Affects)>& wanted) {
  for (const settings::Setting& setting : settings::all())
    if (wanted(setting.affects) && !setting.help.empty()) add_setting(app, setting, options);
}

void add_method(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("Light transport");
  add_lobes(app,
            "kernel file with a reflectance model of your own, which the scene uses as <bsdf type=\"NAME\">; "
            "may be repeated",
            options.lobes);
  add_settings(app, options, [](Affects affects) {
    return affects == Affects::expectation || affects == Affects::estimate;
  });
}

void add_amount(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("Samples and size");
  add_settings(app, options, [](Affects affects) { return affects == Affects::amount; });
  add_value(app, "--size", "WxH",
            "image size in pixels; default: the scene's. The field of view along fovAxis is kept",
            [&](const std::string& text) { options.size = settings::size("--size", text); });
  add_settings(app, options, [](Affects affects) { return affects == Affects::samples; });
  add_values(app, "-D", "NAME=VALUE", "replaces $NAME in the scene; may be repeated",
             [&](const std::string& text) {
               auto [name, value] = settings::definition("-D", text);
               options.definitions.insert_or_assign(std::move(name), std::move(value));
             });
}

void add_device(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("Device");
  add_values(app, "--device", "SPEC",
             "P:D (platform:device, see phlux devices), cpu, gpu, all, or part of a platform's or device's "
             "name; may be repeated. Where two drivers offer the same CPU, cpu and names choose the first",
             [&](const std::string& text) { options.devices.push_back(text); });
  add_settings(app, options, [](Affects affects) { return affects == Affects::execution; });
  add_kernel_dir(app, options.kernel_dir);
}

void add_files(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("Files and messages");
  add_file(app, "-o,--output", "FILE.exr", "the image; default: the scene's name in the working directory",
           options.output);
  add_file(app, "--png", "FILE",
           "tone-mapped preview, updated while rendering; default: beside the image; none: no preview",
           options.preview);
  add_file(app, "--contributions", "DIR",
           "bidir and light: a folder with an image for every technique (s light and t eye vertices), "
           "weighted and unweighted, and a contact sheet",
           options.contributions);
  add_file(app, "--stats", "FILE.json", "statistics of the render, as JSON", options.statistics);
  add_file(app, "--checkpoint", "FILE",
           "file to resume from, written at intervals, at the end and on interruption; default: the file of "
           "--resume, if given; none: no checkpoint",
           options.checkpoint);
  add_value(app, "--checkpoint-every", "SECONDS",
            fmt::format("seconds between checkpoints; default: {:g}", default_checkpoint_seconds),
            [&](const std::string& text) {
              options.checkpoint_seconds = settings::number_within("--checkpoint-every", text, 0.01, 1e9);
            });
  add_file(
      app, "--resume", "FILE",
      "continues from a checkpoint, with its options where this command gives none; -n, --time and --error "
      "include what was rendered before",
      options.resume);
  app.add_flag(
      "--moments", options.moments,
      "adds the channels variance.R, .G and .B (variance of the mean) and reliability (predicted probability "
      "that mean +- 1.96 standard errors holds the right value)");
  app.add_flag(
      "--advise", options.advise,
      "tries the other integrators for a second each and says which is better, if any; without this option "
      "only where the error estimate is unreliable and that takes at most 3% of the render time");
  app.add_flag("-q,--quiet", options.quiet,
               "no progress, no summary and no warning of an unreliable error estimate");
  app.add_flag("--verbose", options.verbose, "also notes: what was ignored, and what was chosen");
}

void add_render(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("render", "Renders a scene to an OpenEXR image and a PNG preview");
  const auto options = std::make_shared<RenderOptions>();
  app.add_option("SCENE.xml", options->scene_file, "Mitsuba scene file")->type_name("")->required();
  add_files(app, *options);
  add_amount(app, *options);
  add_method(app, *options);
  add_device(app, *options);
  app.footer(" "); // instead of the program's footer
  app.final_callback([&command, options] {
    if (options->has("spp") && (options->has("time") || options->has("error")))
      throw UsageError("--spp: cannot go with --time or --error, which decide how many samples are taken");
    if (options->checkpoint_seconds && options->checkpoint.empty() && options->resume.empty())
      throw UsageError("--checkpoint-every: no checkpoint is written: give --checkpoint FILE too");
    command = [options] { return render(*options); };
  });
}

void add_devices(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("devices", "Lists the OpenCL devices and what phlux would use");
  const auto options = std::make_shared<DevicesOptions>();
  app.add_flag("--json", options->json, "as JSON");
  app.final_callback([&command, options] { command = [options] { return list_devices(*options); }; });
}

CompareOptions::Limit limit_of(const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  CompareOptions::Limit limit{text.substr(0, equals), 0.0};
  const char *value = text.data() + std::min(equals + 1, text.size()), *end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(value, end, limit.value);
  if (std::ranges::find(files::metric_names, limit.metric) == files::metric_names.end() ||
      error != std::errc() || stop != end || !std::isfinite(limit.value) || limit.value < 0.0)
    throw UsageError(fmt::format("--fail-above {}: must be METRIC=VALUE, where METRIC is one of {} and VALUE "
                                 "a number of 0 or more",
                                 text.empty() ? "''" : text, fmt::join(files::metric_names, ", ")));
  return limit;
}

void add_compare(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("compare", "Compares an image with a reference");
  const auto options = std::make_shared<CompareOptions>();
  app.add_option("A.exr", options->a, "image")->type_name("")->required();
  app.add_option("B.exr", options->b, "reference")->type_name("")->required();
  app.add_flag("--json", options->json, "as JSON");
  add_values(app, "--fail-above", "METRIC=VALUE",
             fmt::format("exit code 1 if the metric is above the value, or undefined: {}; may be repeated",
                         fmt::join(files::metric_names, ", ")),
             [options](const std::string& text) { options->limits.push_back(limit_of(text)); });
  add_file(app, "--png", "FILE",
           "picture of A, B and their relative difference in false colours: of R, G and B the one that "
           "differs most; A is exposed as B is",
           options->picture);
  app.footer("mean_a_rgb and mean_b_rgb are the means of R, G and B; mean_error is |mean_a / mean_b - 1|.\n"
             "relmse is the mean of (a-b)^2 / (b^2 + 1e-4), relmse_trimmed the same without the largest 0.1% "
             "of pixels;\n"
             "max_z and z_share_over_3 need images rendered with --moments.\n"
             "psnr, in dB, is of the images on a screen: both exposed as B is, tone-mapped, sRGB, peak 1; "
             "larger is better.\n"
             "Exit code: 0, or 1 when a metric is above its limit. Without --fail-above nonfinite=N, a value "
             "that is\nnot finite suffices.");
  app.final_callback([&command, options] { command = [options] { return compare(*options); }; });
}

void add_merge(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("merge", "Merges several renders of a scene into one image");
  const auto options = std::make_shared<MergeOptions>();
  app.add_option("IMAGE.exr", options->images,
                 "two or more renders with different seeds, or different samples of one seed")
      ->type_name("")
      ->required();
  app.add_option("-o,--output", options->output, "the merged image")->type_name("OUT.exr")->required();
  app.footer("Images are weighted by their samples. Variances are merged where all images have them.");
  app.final_callback([&command, options] { command = [options] { return merge(*options); }; });
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

// The innermost command on the line.
const CLI::App& chosen_of(const CLI::App& program) {
  const CLI::App* app = &program;
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  return *app;
}

// "phlux", or "phlux bench rays".
std::string full_name(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name()
                                     : fmt::format("{} {}", full_name(*app.get_parent()), app.get_name());
}

// CLI11 collects unknown arguments. The first unknown option is reported before anything that is missing.
[[noreturn]] void reject(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& app = chosen_of(program);
  const std::string help = full_name(app) + " --help";
  const std::vector<std::string> unknown = program.remaining(true);
  for (const std::string& text : unknown) {
    if (!text.starts_with('-')) continue;
    const std::string meant = settings::nearest(text.substr(0, text.find('=')), option_names(app));
    throw UsageError(
        fmt::format("unknown option {}: {}", text,
                    meant.empty() ? help + " lists the options" : fmt::format("did you mean {}?", meant)));
  }
  if (const auto commands = app.get_subcommands({}); !commands.empty()) {
    std::vector<std::string> names;
    for (const CLI::App* command : commands) names.push_back(command->get_name());
    const std::string meant = unknown.empty() ? "" : settings::nearest(unknown.front(), names);
    const std::string missing = app.get_parent() == nullptr ? "no command" : app.get_name() + ": no command";
    throw UsageError(fmt::format("{}: {}", unknown.empty() ? missing : "unknown command " + unknown.front(),
                                 meant.empty() ? fmt::format("must be one of {}", fmt::join(names, ", "))
                                               : fmt::format("did you mean {}?", meant)));
  }
  if (!unknown.empty())
    throw UsageError(fmt::format("{}: one argument too many: see {}", unknown.front(), help));
  const std::string what = error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    throw UsageError(fmt::format("{}: a value is missing: see {}", what.substr(0, what.find(':')), help));
  throw UsageError(fmt::format("{}: see {}", what, help));
}

} // namespace

std::optional<Command> parse(int argc, char** argv) {
  std::optional<Command> command;
  CLI::App program("phlux: path tracing of Mitsuba scenes on any OpenCL device", "phlux");
  program.set_version_flag(
      "--version", version_report,
      "prints version, commit, compiler, libraries and OpenCL platforms, for bug reports");
  program.require_subcommand(1);
  program.get_formatter()->label("REQUIRED", ""); // the usage line shows it already
  program.footer("phlux COMMAND --help lists the options of a command.\n"
                 "Exit codes: 0 done, 1 a check or comparison failed, 2 wrong usage, 3 bad scene or file,\n"
                 "4 no device or it failed, 5 write failed, 130 interrupted.");
  add_render(program, command);
  add_devices(program, command);
  add_compare(program, command);
  add_merge(program, command);
  add_bench(program, command);
  add_verify(program, command);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    program.exit(help_or_version);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    reject(program, error);
  }
  return command;
}

} // namespace phlux::cli
