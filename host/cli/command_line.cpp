#include "cli/command_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.h"
#include "cli/grammar.h"
#include "cli/shell.h"
#include "cli/version.h"
#include "errors.h"
#include "files/compare.h"
#include "files/tev.h"
#include "settings/values.h"
#include "terminal.h"

namespace phlux::cli {
namespace {

void add_devices(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand(
      "devices", "Lists the OpenCL devices, and marks the one that phlux uses by default");
  const auto options = std::make_shared<DevicesOptions>();
  add_flag(app, "--json", "as JSON", options->json);
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
  add_flag(app, "--json", "as JSON", options->json);
  add_values(app, "--fail-above", "METRIC=VALUE",
             fmt::format("makes the exit code 1 if the metric is above the value or undefined; METRIC is {}; "
                         "may be repeated",
                         fmt::join(files::metric_names, ", ")),
             [options](const std::string& text) { options->limits.push_back(limit_of(text)); });
  add_file(
      app, "--png", "FILE",
      "picture of A, B and their relative difference in false colours, in the channel that differs most; "
      "both have the exposure of B",
      options->picture);
  add_file(app, "--html", "FILE", "HTML page that switches between A, B and the difference", options->page);
  app.footer(
      "mean_a_rgb and mean_b_rgb are the means of R, G and B. mean_error is |mean_a / mean_b - 1|.\n"
      "relmse is the mean of (a-b)^2 / (b^2 + 1e-4); relmse_trimmed is the same without the largest\n"
      "0.1% of the pixels. max_z and z_share_over_3 need images rendered with --moments. psnr, in dB,\n"
      "compares the images as a screen shows them: both with the exposure of B, tone-mapped, sRGB,\n"
      "peak 1; larger is better.\n"
      "Exit code: 0, or 1 if a metric is above its limit. The limit of nonfinite is 0 unless\n"
      "--fail-above sets another.");
  app.final_callback([&command, options] { command = [options] { return compare(*options); }; });
}

void add_merge(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("merge", "Merges several renders of a scene into one image");
  const auto options = std::make_shared<MergeOptions>();
  app.add_option(
         "IMAGE.exr", options->images,
         "two or more renders of one scene with different seeds, or with different samples of one seed")
      ->type_name("")
      ->required();
  app.add_option("-o,--output", options->output, "the merged image")->type_name("OUT.exr")->required();
  app.footer(
      "Images are weighted by their numbers of samples. Variances are merged if all images have them.");
  app.final_callback([&command, options] { command = [options] { return merge(*options); }; });
}

void add_view(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("view", "Shows an image in the viewer tev, or converts it to PNG");
  const auto options = std::make_shared<ViewOptions>();
  app.add_option("FILE.exr", options->image, "image")->type_name("")->required();
  add_file(app, "--png", "FILE", "writes a tone-mapped PNG instead", options->picture);
  add_exposure(app, options->exposure);
  options->tev = files::tev_address;
  add_value(app, "--tev", "HOST:PORT", fmt::format("where tev listens; default: {}", files::tev_address),
            [options](const std::string& text) { options->tev = text; });
  app.footer("tev is at github.com/Tom94/tev. It shows all channels, also those of --moments and --aov.");
  app.final_callback([&command, options] {
    if (options->exposure && options->picture.empty())
      throw UsageError(
          fmt::format("--exposure {:g}: is for --png: tev has its own exposure", *options->exposure));
    command = [options] { return view(*options); };
  });
}

// Prints a text that is made from the grammar of the whole program.
void add_text(CLI::App& app, std::optional<Command>& command, const CLI::App& program,
              std::string (*text)(const std::vector<CommandText>&)) {
  app.final_callback([&command, &program, text] {
    command = [printed = text(commands_of(program))] {
      say("{}", printed);
      return 0;
    };
  });
}

void add_completion(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app =
      *program.add_subcommand("completion", "Prints a script for the completion of commands and options");
  app.require_subcommand(1);
  app.footer("For bash: source <(phlux completion bash)\n"
             "For zsh: phlux completion zsh > FOLDER/_phlux, where FOLDER is in $fpath\n"
             "cmake --install writes both to where the shells look for them.");
  add_text(*app.add_subcommand("bash", "Prints it for bash"), command, program, bash_completion);
  add_text(*app.add_subcommand("zsh", "Prints it for zsh"), command, program, zsh_completion);
  add_text(*program.add_subcommand("man", "Prints the manual page, phlux.1"), command, program, manual_page);
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
  CLI::App program(
      "phlux: path tracing, light tracing and bidirectional path tracing of Mitsuba scenes in OpenCL",
      "phlux");
  program.set_version_flag(
      "--version", version_report,
      "prints version, commit, compiler, libraries and OpenCL platforms, for bug reports");
  program.require_subcommand(1);
  program.get_formatter()->label("REQUIRED", ""); // the usage line shows it already
  program.footer("phlux COMMAND --help lists the options of a command.\n"
                 "Exit codes: 0 done, 1 a check or comparison failed, 2 wrong usage, 3 bad scene or file,\n"
                 "4 no device, or all failed, 5 write failed, 130 interrupted.");
  add_render(program, command);
  add_info(program, command);
  add_devices(program, command);
  add_compare(program, command);
  add_merge(program, command);
  add_view(program, command);
  add_bench(program, command);
  add_verify(program, command);
  add_completion(program, command);
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
