// The grammar of `phlux render` and `phlux info`.
#include <algorithm>
#include <initializer_list>
#include <memory>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "cli/checkpoints.h"
#include "cli/commands.h"
#include "cli/grammar.h"
#include "cli/work.h"
#include "cluster/group.h"
#include "errors.h"
#include "files/image.h"
#include "settings/values.h"

namespace phlux::cli {
namespace {

using settings::Affects;

// Adds the settings of these kinds, without those that another group of the help has.
void add_settings(CLI::App& app, RenderOptions& options, std::initializer_list<Affects> kinds) {
  for (const settings::Setting& setting : settings::all())
    if (std::ranges::find(kinds, setting.affects) != kinds.end() && !setting.help.empty() &&
        setting.name != "crop" && setting.name != "precision")
      add_setting(app, setting, options);
}

void add_method(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("Light transport");
  add_lobes(app,
            "kernel file with a reflectance model of your own, which the scene refers to by <bsdf "
            "type=\"NAME\">; may be repeated",
            options.lobes);
  add_settings(app, options, {Affects::expectation, Affects::estimate});
}

void add_scene_options(CLI::App& app, RenderOptions& options) {
  add_value(app, "--size", "WxH",
            "image size in pixels; the field of view along fovAxis does not change; default: the scene's",
            [&](const std::string& text) { options.size = settings::size("--size", text); });
  add_setting(app, settings::named("crop"), options);
  add_values(app, "-D", "NAME=VALUE", "replaces $NAME in the scene; may be repeated",
             [&](const std::string& text) {
               const auto [name, value] = settings::definition("-D", text);
               const auto [known, is_new] = options.definitions.emplace(name, value);
               if (!is_new && known->second != value)
                 throw UsageError(fmt::format("-D {}: and -D {}={} is given too: give one of the two", text,
                                              name, known->second));
             });
}

void add_amount(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("Samples and size");
  add_settings(app, options, {Affects::amount});
  add_scene_options(app, options);
  add_settings(app, options, {Affects::samples});
}

void add_device(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("Device");
  add_values(
      app, "--device", "SPEC",
      "indices P:D (platform:device) as listed by phlux devices, cpu, gpu, all, or a part of the name of a "
      "platform or device; may be repeated. If two drivers offer the same CPU, cpu and names choose the "
      "first driver's",
      [&](const std::string& text) { options.devices.push_back(text); });
  add_settings(app, options, {Affects::execution});
  add_setting(app, settings::named("precision"), options);
  add_kernel_dir(app, options.kernel_dir);
}

// Names separated by commas, each once.
std::vector<std::string> aov_of(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream parts(text + ",");
  for (std::string part; std::getline(parts, part, ',');) {
    const std::string& name = files::aov_names[settings::choice("--aov", part, files::aov_names)];
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

void add_files(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("Files and messages");
  add_file(app, "-o,--output", "FILE.exr",
           "the image; default: the name of the scene, in the working directory", options.output);
  add_file(
      app, "--png", "FILE",
      "tone-mapped preview, updated while rendering; default: the image's name with .png; none: no preview",
      options.preview);
  add_exposure(app, options.exposure);
  add_file(app, "--contributions", "DIR",
           "bidir and light: folder for images of the contributions of every technique (s light and t eye "
           "vertices), weighted and unweighted, and a contact sheet",
           options.contributions);
  add_file(app, "--stats", "FILE.json", "statistics of the render, as JSON", options.statistics);
  add_file(app, "--checkpoint", "FILE",
           "file from which --resume can continue, written at intervals, at the end and on interruption; "
           "default: the file of --resume, if given; none: no checkpoint",
           options.checkpoint);
  add_value(app, "--checkpoint-every", "SECONDS",
            fmt::format("seconds between checkpoints; default: {:g}", default_checkpoint_seconds),
            [&](const std::string& text) {
              options.checkpoint_seconds = settings::number_within("--checkpoint-every", text, 0.01, 1e9);
            });
  add_file(
      app, "--resume", "FILE",
      "continues from a checkpoint; options that are not given keep their values; -n, --time and --error "
      "count from the beginning of the first render",
      options.resume);
  add_value(app, "--memory", "GB",
            "the most memory that the film may take; default: what is free. What is beyond it is kept in a "
            "temporary file, in $TMPDIR or /var/tmp",
            [&](const std::string& text) {
              options.memory = 1e9 * settings::number_within("--memory", text, 0.0, 1e9);
            });
  add_value(
      app, "--aov", "NAME,...",
      "adds channels with properties of the surface that camera rays hit first, and their variances, for "
      "denoisers and compositing: albedo, normal, depth",
      [&](const std::string& text) { options.aov = aov_of(text); });
  add_flag(
      app, "--moments",
      "adds the channels variance.R, .G and .B (variance of the mean) and reliability (predicted probability "
      "that the true value is within 1.96 standard errors of the mean)",
      options.moments);
  add_flag(
      app, "--advise",
      "afterwards tries the other integrators for a second each, and names a better one if there is one; "
      "without this option only if the error estimate is unreliable, and for at most 3% of the render time",
      options.advise);
  add_flag(app, "-q,--quiet", "no progress, no summary and no warning of an unreliable error estimate",
           options.quiet);
  add_flag(app, "--verbose", "also prints what was ignored in the scene, and what was chosen automatically",
           options.verbose);
}

// With several scenes each writes to files of its own name.
void require_own_files(const RenderOptions& options, const std::vector<std::filesystem::path>& scenes) {
  if (scenes.size() < 2) return;
  if (const cluster::Started started = cluster::started(); started.processes > 1)
    throw UsageError(fmt::format("{} has started {} processes, which can render only one scene: {} are given",
                                 started.by, started.processes, scenes.size()));
  const std::pair<const char*, std::filesystem::path> files[] = {{"--output", options.output},
                                                                 {"--stats", options.statistics},
                                                                 {"--contributions", options.contributions},
                                                                 {"--resume", options.resume},
                                                                 {"--checkpoint", options.checkpoint},
                                                                 {"--png", options.preview}};
  for (const auto& [option, file] : files)
    if (!file.empty() && file != "none")
      throw UsageError(fmt::format("{} {}: can be used with one scene only: {} are given", option,
                                   file.string(), scenes.size()));
  std::set<std::string> names;
  for (const std::filesystem::path& scene : scenes)
    if (!names.insert(scene.stem().string()).second)
      throw UsageError(
          fmt::format("{}: another scene is called {} too, and both would be written to {}.exr: render "
                      "each by its own command, with --output",
                      scene.string(), scene.stem().string(), scene.stem().string()));
}

// The first exit code that is not 0, which ends it.
int render_all(RenderOptions options, const std::vector<std::filesystem::path>& scenes) {
  std::error_code none;
  for (const std::filesystem::path& scene : scenes) // before the first is rendered
    if (!std::filesystem::is_regular_file(scene, none) && !is_worker())
      throw SceneError(
          fmt::format("{}: cannot be read: an existing Mitsuba scene file is needed", scene.string()));
  for (const std::filesystem::path& scene : scenes) {
    options.scene_file = scene;
    if (const int exit_code = render(options); exit_code != 0) return exit_code;
  }
  return 0;
}

} // namespace

void add_render(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("render", "Renders a scene to an OpenEXR image and a PNG preview");
  const auto options = std::make_shared<RenderOptions>();
  const auto scenes = std::make_shared<std::vector<std::filesystem::path>>();
  app.add_option("SCENE.xml", *scenes,
                 wrapped("Mitsuba scene file; several scenes are rendered one after the other"))
      ->type_name("")
      ->required();
  add_files(app, *options);
  add_amount(app, *options);
  add_method(app, *options);
  add_device(app, *options);
  app.footer(" "); // instead of the program's footer
  app.final_callback([&command, options, scenes] {
    if (options->has("spp") && (options->has("time") || options->has("error")))
      throw UsageError("--spp: excludes --time and --error, which determine the number of samples");
    if (options->exposure && options->preview == "none")
      throw UsageError("--exposure: is for the preview, and --png none makes none: leave out one of the two");
    if (options->advise && options->quiet && options->statistics.empty())
      throw UsageError("--advise: --quiet silences it: leave out one of the two, or give --stats FILE.json");
    if (options->checkpoint_seconds &&
        (options->checkpoint == "none" || (options->checkpoint.empty() && options->resume.empty())))
      throw UsageError("--checkpoint-every: no checkpoint is written: give --checkpoint FILE too");
    require_own_files(*options, *scenes);
    command = [options, scenes] { return render_all(*options, *scenes); };
  });
}

void add_info(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand(
      "info", "Lists what is in a scene, the parts of its kernel, and the memory that a render takes");
  const auto options = std::make_shared<InfoOptions>();
  app.add_option("SCENE.xml", options->scene_file, "Mitsuba scene file")->type_name("")->required();
  add_flag(app, "--json", "as JSON", options->json);
  add_scene_options(app, *options);
  add_method(app, *options);
  add_device(app, *options);
  app.final_callback([&command, options] { command = [options] { return info(*options); }; });
}

} // namespace phlux::cli
