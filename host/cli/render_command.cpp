#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "advice/automatic.h"
#include "checkpoint/sameness.h"
#include "cli/attempts.h"
#include "cli/checkpoints.h"
#include "cli/commands.h"
#include "cli/diagnosis.h"
#include "cli/interrupt.h"
#include "cli/memory.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/spelling.h"
#include "cli/statistics.h"
#include "cli/work.h"
#include "clock.h"
#include "errors.h"
#include "files/contributions.h"
#include "files/exr.h"
#include "files/json.h"
#include "files/output.h"
#include "files/png.h"
#include "printable.h"
#include "render/first_hits.h"
#include "scene/digest.h"
#include "scene/image_size.h"
#include "scene_file/load.h"
#include "terminal.h"

namespace phlux::cli {
namespace {

// The film's relative standard error, computed at most twice a second and for at most 2% of the time. Between
// computations it is extrapolated: it falls with the square root of the samples.
class ErrorSoFar {
public:
  explicit ErrorSoFar(const film::Film& film) : film_(film) {}
  double at(double samples) {
    const Clock::time_point start = Clock::now();
    if (start >= next_) {
      value_ = film_.relative_standard_error();
      samples_ = samples;
      const Clock::time_point end = Clock::now();
      next_ = end + std::max<Clock::duration>(std::chrono::milliseconds(500), 50 * (end - start));
    }
    return samples > 0.0 ? value_ * std::sqrt(samples_ / samples) : value_;
  }

private:
  const film::Film& film_;
  double value_ = std::numeric_limits<double>::infinity(), samples_ = 0.0;
  Clock::time_point next_{};
};

// Replaces `--integrator auto` by a method.
void choose_integrator(RenderOptions& options, const scene::Scene& scene, const cluster::Group& group) {
  const auto integrator = options.texts.find("integrator");
  if (integrator == options.texts.end() || integrator->second != "auto") return;
  const advice::MethodChoice choice = advice::choose_method(scene, options, defaults_of(options, group));
  for (const auto& [name, text] : choice.texts) options.texts.insert_or_assign(name, text);
  options.auto_reasons = with_options(choice.words);
  if (!options.quiet) say("auto: {}\n", printable(options.auto_reasons));
}

// Adds the file name, which the renderer does not know, to its errors.
render::Statistics render_scene(const scene::Scene& scene, const render::Settings& settings, film::Film& film,
                                const render::Events& events, const render::RenderState& from,
                                const std::vector<render::Processor*>& workers,
                                const std::filesystem::path& file) try {
  return render::render(scene, settings, film, events, from, workers);
} catch (const SceneError& error) {
  throw SceneError(fmt::format("{}: {}", file.string(), error.what()));
}

// Renders. Failing devices end a render early, as an interruption does, and are added to `attempts`.
render::Statistics run(const scene::Scene& scene, const render::Settings& settings, film::Film& film,
                       const Outputs& outputs, const RenderOptions& options, Checkpoints& checkpoints,
                       const render::RenderState& from, const cluster::Team& team,
                       const InterruptGuard& interrupt, Attempts& attempts) {
  ProgressDisplay display(options.quiet, settings.time_limit, settings.target_error);
  PreviewRefresher preview(outputs.preview, options.exposure);
  ErrorSoFar error(film);
  bool interrupted = false;
  render::Events events;
  events.warning = [&](const std::string& text) {
    display.clear();
    spdlog::warn("{}", with_options(text));
  };
  events.building_kernels = [&] { display.building_kernels(); };
  events.progress = [&](const render::Progress& progress) {
    display.update(progress, [&] { return error.at(progress.samples_done); });
    preview.update(film, progress.seconds, [&] { return interrupt.requested(); });
    checkpoints.update(film, progress);
    interrupted = interrupt.requested();
    return !interrupted;
  };
  render::Statistics statistics;
  try {
    statistics = render_scene(scene, settings, film, events, from, team.workers(), options.scene_file);
  } catch (const render::DevicesFailed& failure) {
    attempts.failed(failure);
    statistics = failure.statistics;
    interrupted = true;
  }
  statistics.interrupted = interrupted;
  return statistics;
}

std::string missed_light(const scene::Scene& scene, const render::Settings& settings) {
  const settings::IntegratorInfo& integrator = settings::integrator_named(settings.integrator);
  if (!advice::misses_light(scene, integrator)) return {};
  return integrator.eye_paths ? "light of point, spot and directional emitters by mirrors or glass"
                              : "light that mirrors or glass bring to the camera";
}

files::RenderInfo info_of(const checkpoint::Session& session, const scene::Scene& scene,
                          const film::Film& film, const render::Statistics& statistics) {
  const render::Settings& settings = session.settings;
  return {
      .version = PHLUX_VERSION,
      .scene = session.scene,
      .scene_digest = checkpoint::scene_part(session.scene_digest),
      .settings = files::stored(settings),
      .choice = session.choices.auto_reasons,
      .samples = film.samples_per_pixel(),
      .seed = settings.seed,
      .ranges = {{settings.seed, settings.first_sample, settings.first_sample + statistics.position.end()}},
      .device = statistics.device,
      .driver = statistics.driver,
      .seconds = statistics.seconds_render,
      .clamped_share = film.clamped_share(),
      .missed_light = missed_light(scene, settings),
      .origin = scene.camera.origin,
      .whole = scene.camera.whole};
}

// Writes the image where it can. Returns its path, empty if it cannot be written.
std::filesystem::path write_image(const std::filesystem::path& wanted, const files::Rows& rows,
                                  const files::RenderInfo& info, LastSteps& steps, Attempts& attempts) {
  const auto write = [&](const std::filesystem::path& file) {
    const auto progress = steps.needed("writing " + printable(file.string()));
    const files::NonFinite not_finite = files::write_exr(file, files::with_progress(rows, progress), info);
    steps.clear();
    warn_of_nonfinite(file, not_finite);
  };
  try {
    write(wanted);
    return wanted;
  } catch (const WriteError& error) {
    const std::filesystem::path second = files::elsewhere(wanted);
    try {
      write(second);
    } catch (const WriteError& other) {
      attempts.failed(WriteError(fmt::format("{}; {}", error.what(), other.what())));
      return {};
    }
    attempts.failed(WriteError(fmt::format("{}; the image is in {}", error.what(), second.string())));
    return second;
  }
}

void write_techniques(const std::filesystem::path& folder, film::Film& film, const files::RenderInfo& info,
                      LastSteps& steps, Patience& patience) {
  const files::NonFinite not_finite =
      files::write_contributions(folder, film, info, steps.optional("writing the contributions", patience));
  steps.clear();
  warn_of_nonfinite(folder, not_finite);
  if (const std::uint64_t left_out = film.techniques()->left_out(); left_out > 0)
    spdlog::warn(
        "--contributions: paths of more than {} edges ({} contributions) are only in the image of the render",
        film::most_technique_edges, left_out);
}

std::string summary(const std::filesystem::path& image, const std::filesystem::path& checkpoint,
                    const film::Film& film, const render::Statistics& statistics, double error) {
  const double seconds = statistics.seconds_render;
  std::string text = fmt::format("{}: {}x{}, {:.6g} samples per pixel, {:.3g} s", image.string(),
                                 film.width(), film.height(), film.samples_per_pixel(), seconds);
  if (seconds > 0.0)
    text += fmt::format(", {:.3g} M paths/s", 1e-6 * static_cast<double>(statistics.paths) / seconds);
  if (std::isfinite(error))
    text +=
        fmt::format(", relative standard error {:.3g}%{}", 100.0 * error,
                    film.samples_per_pixel() < film::least_samples ? " (of too few samples to trust)" : "");
  if (!statistics.interrupted) return text;
  return text + ", interrupted" +
         (checkpoint.empty() ? "" : ": --resume " + checkpoint.string() + " goes on");
}

// Everything that a render leaves, the image first. A failure of one prevents no other.
void write_all(const Outputs& outputs, const RenderOptions& options, const checkpoint::Session& session,
               film::Film& film, const render::Statistics& statistics, scene::Scene&& scene,
               Checkpoints& checkpoints, const InterruptGuard& interrupt, Attempts& attempts) {
  using namespace std::chrono_literals;
  LastSteps steps(options.quiet, [&] { return interrupt.requested(); });
  Patience for_channels(10s), for_rest(1s); // image and checkpoint are written in any case
  const render::Settings& settings = session.settings;
  const files::RenderInfo info = info_of(session, scene, film, statistics);
  std::filesystem::path image_file, checkpoint_file;
  std::vector<film::FirstHit> hits;
  if (!outputs.aov.empty())
    attempts("--aov", [&] {
      hits = render::first_hits(scene, settings, steps.optional("computing the first hits", for_channels));
    });
  attempts(outputs.image, [&] {
    const bool with_variances = options.moments && film.has_variance();
    if (options.moments && !with_variances)
      spdlog::warn("--moments: variances need two samples in every pixel: their channels are left out");
    files::Rows rows =
        files::rows_of(film, with_variances, steps.needed("computing the reliability of the error"));
    if (!hits.empty()) files::add_first_hits(rows, hits, outputs.aov);
    image_file = write_image(outputs.image, rows, info, steps, attempts);
  });
  attempts(outputs.checkpoint, [&] {
    checkpoints.finish(film, statistics, steps.needed("writing " + printable(outputs.checkpoint.string())));
    checkpoint_file = outputs.checkpoint;
  });
  if (!outputs.preview.empty())
    attempts(outputs.preview, [&] {
      const auto progress = steps.optional("writing " + printable(outputs.preview.string()), for_rest);
      files::write_png(outputs.preview, files::with_progress(files::rows_of(film, false), progress),
                       options.exposure);
    });
  if (settings.techniques)
    attempts(options.contributions,
             [&] { write_techniques(options.contributions, film, info, steps, for_rest); });
  Diagnosis diagnosis;
  attempts("the error", [&] { estimate_error(film, steps, for_rest, diagnosis); });
  attempts("trials of other integrators", [&] {
    try_other_methods(statistics, settings, std::move(scene), options.advise, steps, for_rest, diagnosis);
  });
  if (!outputs.statistics.empty())
    attempts(outputs.statistics, [&] {
      files::write_file(outputs.statistics,
                        files::json_text(statistics_json(statistics, settings, info, film, diagnosis)));
    });
  steps.clear();
  if (!options.quiet && !image_file.empty())
    say("{}\n",
        printable(summary(image_file, checkpoint_file, film, statistics, diagnosis.error.standard_error)));
  report(diagnosis, film, statistics, settings, info.clamped_share, options.quiet);
}

} // namespace

render::Settings defaults_of(const RenderOptions& options) {
  render::Settings defaults;
  defaults.techniques = !options.contributions.empty();
  defaults.devices = options.devices;
  defaults.kernel_dir = options.kernel_dir;
  return defaults;
}

void crop(scene::Scene& scene, const settings::Choices& choices) {
  const settings::Setting& setting = settings::named("crop");
  render::Settings settings;
  setting.from_scene(scene.defaults, settings);
  if (choices.has("crop")) setting.read(choices.texts.at("crop"), settings);
  if (!settings.crop) return;
  scene::Camera& camera = scene.camera;
  if (!scene::is_within(*settings.crop, camera))
    throw UsageError(fmt::format("--crop {}: is not within the image of {}x{} pixels", setting.text(settings),
                                 camera.width, camera.height));
  scene::crop_image(camera, *settings.crop);
}

int render(const RenderOptions& given) {
  cluster::Group group;
  group.divide_cores();
  if (group.rank() > 0) return work(group, given);
  cluster::Team team(group);
  if (given.verbose) spdlog::set_level(spdlog::level::info);
  const Outputs outputs = outputs_of(given);
  check_writable(outputs);
  RenderOptions options = given;
  std::optional<checkpoint::Checkpoint> earlier = resumed(options);
  scene::Scene scene =
      scene_file::load(options.scene_file, options.definitions, options.size, lobes::Library(options.lobes));
  reject_inputs(outputs, options, scene);
  const std::string digest = scene::digest(scene); // of the whole image
  crop(scene, options);
  choose_integrator(options, scene, group);
  const render::Settings settings =
      settings::settings_of(options, scene.defaults, defaults_of(options, group));
  const checkpoint::Session session{.scene = options.scene_file.string(),
                                    .scene_digest = checkpoint::digest_with_strategy(digest, settings),
                                    .choices = options,
                                    .settings = settings,
                                    .state = {}};
  const scene::Camera& camera = scene.camera;
  if (earlier) check_same(*earlier, session, camera, options.resume);
  film::Film film = earlier ? std::move(earlier->film)
                            : film::Film(camera.width, camera.height,
                                         storage_for(camera, session.settings, outputs, options.memory));
  Checkpoints checkpoints(outputs.checkpoint, options, session);
  const InterruptGuard interrupt; // until everything is written
  team.start(options, session.scene_digest, [&] { return interrupt.requested(); });
  Attempts attempts;
  const render::Statistics statistics =
      run(scene, session.settings, film, outputs, options, checkpoints,
          earlier ? earlier->session.state : render::RenderState(), team, interrupt, attempts);
  if (film.samples_per_pixel() == 0.0) // an older image is worth more than a black one
    spdlog::warn("the render ended before its first sample: no file is written or replaced");
  else
    write_all(outputs, options, session, film, statistics, std::move(scene), checkpoints, interrupt,
              attempts);
  return attempts.report(statistics.interrupted ? interrupted_exit_code : 0);
}

} // namespace phlux::cli
