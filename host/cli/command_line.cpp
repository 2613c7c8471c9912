#include "cli/command_line.h"

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
#include "settings/values.h"

namespace phlux::cli {
namespace {

using settings::Affects;

void add_settings(CLI::App& app, RenderOptions& options, const std::function<bool(Affects)>& wanted) {
  for (const settings::Setting& setting : settings::all())
    if (wanted(setting.affects) && !setting.help.empty()) add_setting(app, setting, options);
}

void add_method(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("How light is found");
  add_lobes(app,
            "a reflectance model of your own: one kernel file, which the scene names as <bsdf "
            "type=\"NAME\">; may be "
            "repeated",
            options.lobes);
  add_settings(app, options, [](Affects affects) {
    return affects == Affects::expectation || affects == Affects::estimate;
  });
}

void add_amount(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("How much");
  add_settings(app, options, [](Affects affects) { return affects == Affects::amount; });
  add_value(app, "--size", "WxH",
            "pixels of the image; default: the scene's. The field of view along fovAxis stays",
            [&](const std::string& text) { options.size = settings::size("--size", text); });
  add_settings(app, options, [](Affects affects) { return affects == Affects::samples; });
  add_values(app, "-D", "NAME=VALUE", "replaces $NAME in the scene; may be repeated",
             [&](const std::string& text) {
               auto [name, value] = settings::definition("-D", text);
               options.definitions.insert_or_assign(std::move(name), std::move(value));
             });
}

void add_device(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("Where it runs");
  add_values(
      app, "--device", "SPEC",
      "P:D as `phlux devices` lists them, cpu, gpu, all, or a part of a platform's or else a device's "
      "name; may be repeated. Of two drivers for the same CPU, cpu and a part of a name take the first",
      [&](const std::string& text) { options.devices.push_back(text); });
  add_settings(app, options, [](Affects affects) { return affects == Affects::execution; });
  add_kernel_dir(app, options.kernel_dir);
}

void add_files(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("What is written");
  const auto add_file = [&](const std::string& names, const std::string& value, const std::string& help,
                            std::filesystem::path& file) {
    add_value(app, names, value, help, [&file, names](const std::string& text) {
      if (text.empty()) throw UsageError(fmt::format("{} '': must be a file name", names));
      file = text;
    });
  };
  add_file("-o,--output", "FILE.exr", "the image; default: the scene's name in the working directory",
           options.output);
  add_file("--png", "FILE",
           "tone-mapped preview, also rewritten while rendering; default: beside the image; none: without",
           options.preview);
  add_file(
      "--contributions", "DIR",
      "bidir and light: an image for every way of making a path, s light and t eye vertices, weighted and "
      "unweighted, and a contact sheet",
      options.contributions);
  add_file("--stats", "FILE.json", "figures of the render", options.statistics);
  add_file("--checkpoint", "FILE",
           "all that the render takes to go on, written now and then, at the end and when it is interrupted; "
           "default: with --resume, that file; none: without",
           options.checkpoint);
  add_value(app, "--checkpoint-every", "SECONDS",
            fmt::format("how often; default: {:g}", default_checkpoint_seconds),
            [&](const std::string& text) {
              options.checkpoint_seconds = settings::number_within("--checkpoint-every", text, 0.01, 1e9);
            });
  add_file(
      "--resume", "FILE",
      "goes on from a checkpoint, with the options that it had and this command does not give; -n, --time "
      "and --error count from its beginning",
      options.resume);
  app.add_flag(
      "--moments", options.moments,
      "adds channels variance.R, .G and .B: variance of the mean; and reliability: how far to trust it");
  app.add_flag(
      "--advise", options.advise,
      "where the error cannot be trusted, tries the other integrators for a second each and says which "
      "does better; without it only where that takes 3% of the time");
  app.add_flag("-q,--quiet", options.quiet, "no progress and no summary");
  app.add_flag("--verbose", options.verbose, "notes on what was passed over and chosen");
}

void add_render(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("render", "Renders a scene to an OpenEXR image and a PNG preview");
  const auto options = std::make_shared<RenderOptions>();
  app.add_option("SCENE.xml", options->scene_file, "Mitsuba scene file")->type_name("")->required();
  add_files(app, *options);
  add_amount(app, *options);
  add_method(app, *options);
  add_device(app, *options);
  app.footer(" "); // not the program's
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

void add_compare(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("compare", "Says how far an image is from a reference");
  const auto options = std::make_shared<CompareOptions>();
  app.add_option("A.exr", options->a, "image")->type_name("")->required();
  app.add_option("B.exr", options->b, "reference")->type_name("")->required();
  app.add_flag("--json", options->json, "as JSON");
  app.footer("relmse is the mean of (a-b)^2 / (b^2 + 1e-4), relmse_trimmed the same without the largest 0.1% "
             "of pixels;\n"
             "max_z and z_share_over_3 need images rendered with --moments.\n"
             "Exit code: 0, or 1 when a value is not finite.");
  app.final_callback([&command, options] { command = [options] { return compare(*options); }; });
}

void add_merge(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("merge", "Makes one image of several renders of a scene");
  const auto options = std::make_shared<MergeOptions>();
  app.add_option("IMAGE.exr", options->images,
                 "two or more renders of different seeds, or of different samples of one")
      ->type_name("")
      ->required();
  app.add_option("-o,--output", options->output, "the merged image")->type_name("OUT.exr")->required();
  app.footer("Images are weighted by their samples. The variance of the mean is merged where all have it.");
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

// The innermost command that the line names.
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

// CLI11 puts what it does not know aside; the first such option explains more than what it then misses.
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
      "version, commit, compiler, libraries and OpenCL platforms: what a report should say");
  program.require_subcommand(1);
  program.get_formatter()->label("REQUIRED", ""); // the usage line says it
  program.footer("phlux COMMAND --help lists the options of a command.\n"
                 "Exit codes: 0 done, 1 a check or comparison failed, 2 wrong usage, 3 bad scene or file, 4 "
                 "no device or it "
                 "failed,\n5 write failed, 130 interrupted.");
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
