#include "bench/scenes/scenes.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/common/methods/build_ahead.h"
#include "bench/common/methods/result_table.h"
#include "bench/common/report/draw.h"
#include "bench/common/status_line.h"
#include "bench/common/tables/array_file.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/fingerprint.h"
#include "bench/common/tables/provenance.h"
#include "bench/scenes/scene_files.h"
#include "clock.h"
#include "device/device.h"
#include "errors.h"
#include "files/output.h"
#include "scene/digest.h"
#include "scene_file/load.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

constexpr double default_seconds = 120, quick_seconds = 11; // per scene
constexpr double default_total = 17 * 60, quick_total = 90;
constexpr int default_side = 128, quick_side = 64;

const std::vector<std::string> convergence_columns = {
    "seconds", "samples_per_pixel", "relmse", "relmse_least", "relmse_most", "relmse_expected", "rounds"};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Run { // settings of all scenes
  const ScenesOptions& options;
  device::DeviceInfo device;
  int lanes = 0;
  std::vector<Method> methods;
  double seconds = 0;      // per scene
  double seconds_left = 0; // per scene, after building kernels

  [[nodiscard]] CostClock clock() const { return clock_of(device); }
};

struct SceneRun {
  std::string name;
  scene::Scene scene;
  std::string settings; // fingerprint of everything that the results depend on, except the method
};

SceneRun load(const std::filesystem::path& file, const Run& run) {
  const int side = run.options.side.value_or(run.options.quick ? quick_side : default_side);
  SceneRun result{file.stem().string(), load_at_size(file, side), {}};
  Fingerprint fingerprint;
  fingerprint.add(text_of(file)); // has the settings of the integrator too
  fingerprint.add(scene::digest(result.scene));
  fingerprint.add(fmt::format("{} {} {} {} {} {} {}", PHLUX_VERSION, run.options.quick, run.seconds,
                              run.options.seed, run.lanes, run.device.name, run.options.kernel_dir.string()));
  result.settings = fingerprint.text();
  return result;
}

struct SceneResults {
  ReferenceImage reference;
  std::vector<MethodResult> methods;
  std::vector<RankedCost> costs; // of the methods
};

// ---- The tables

std::vector<std::string> convergence_values(const ReferenceImage& reference, const MethodResult& result,
                                            const ConvergencePoint& point) {
  std::vector<std::string> row;
  for (const double value :
       {point.seconds, point.samples_per_pixel, point.relmse, point.relmse_least, point.relmse_most,
        result.variance.value / point.samples_per_pixel + reference.image.relmse()})
    row.push_back(number_text(value));
  row.push_back(fmt::format("{}", point.rounds));
  return row;
}

struct Tables {
  explicit Tables(const std::filesystem::path& folder)
      : results(folder, "scenes.csv", {"scene"}, result_columns()),
        convergence(folder, "scenes-convergence.csv", {"scene"}, convergence_columns) {}

  void replace(const Run& run, const SceneRun& scene, const SceneResults& measured) {
    results.remove({scene.name});
    convergence.remove({scene.name});
    for (std::size_t i = 0; i < measured.methods.size(); ++i) {
      const MethodResult& result = measured.methods[i];
      results.add({scene.name}, result.method,
                  result_values(result, measured.costs[i], measured.reference, scene.scene.camera,
                                {run.device.name, run.lanes, run.options.seed, run.clock()}),
                  scene.settings);
      for (const ConvergencePoint& point : result.convergence)
        convergence.add({scene.name}, result.method, convergence_values(measured.reference, result, point),
                        scene.settings);
    }
    write();
  }
  void write() const {
    convergence.write();
    results.write(); // last: its rows then have their convergence rows
  }

  ResultTable results, convergence;
};

// ---- One scene

std::string file_name(const Method& m) {
  return fmt::format("{}-{}-{}.npy", m.integrator, m.variant == "-" ? "all" : m.variant, m.strategy);
}

void write_images(const std::filesystem::path& folder, const scene::Camera& camera,
                  const SceneResults& measured) {
  make_folder(folder);
  const std::vector<std::size_t> shape = {static_cast<std::size_t>(camera.height),
                                          static_cast<std::size_t>(camera.width), 3};
  write_array(folder / "reference.npy", shape, measured.reference.image.radiance);
  for (const MethodResult& result : measured.methods)
    if (result.verdict != Verdict::refused)
      write_array(folder / file_name(result.method), shape, result.first_image.radiance);
}

// Replaces the line of a scene: its name and the answer, as the command prints it.
void write_answer(const std::filesystem::path& file, const std::string& scene, const std::string& answer) {
  const std::string begin = scene + ": ";
  std::istringstream earlier(text_of(file));
  std::set<std::string> lines = {begin + answer};
  for (std::string line; std::getline(earlier, line);)
    if (!line.starts_with(begin)) lines.insert(line);
  files::write_file(file, fmt::format("{}\n", fmt::join(lines, "\n")));
}

std::string ratio_cell(const RankedCost& cost) {
  if (std::isnan(cost.ratio)) return "-";
  return cost.rank == Rank::best ? "1" : text_of_ratio(cost);
}

// The answer comes last, where a terminal shows it.
void print(const Run& run, const SceneRun& scene, const SceneResults& measured) {
  const ReferenceImage& reference = measured.reference;
  const scene::Camera& camera = scene.scene.camera;
  say("{}, {}x{}; reference by {}, {:.0f} samples per pixel, relative MSE {:.2g}\n", scene.name, camera.width,
      camera.height, reference.method, reference.samples_per_pixel, reference.image.relmse());
  say("  {:<28} {:>10} {:>8} {:>14} {:>22}  {}\n", "method", "variance", "ns", "to variance 1",
      "relative to best sound", "");
  const bool any_open = std::ranges::count(measured.costs, Rank::open, &RankedCost::rank) > 0;
  const auto rank_text = [&](Rank rank) {
    return rank == Rank::best && any_open ? "best of the sound ones" : word_of(rank);
  };
  for (std::size_t i = 0; i < measured.methods.size(); ++i) {
    const MethodResult& r = measured.methods[i];
    const RankedCost& cost = measured.costs[i];
    if (r.verdict == Verdict::refused) {
      say("  {:<28} {}: {}\n", r.method.name(), word_of(r.verdict), r.reason);
      continue;
    }
    const bool ranked = r.verdict == Verdict::sound;
    say("  {:<28} {:>10.4g} {:>8.1f} {:>14} {:>22}  {}{}{}\n", r.method.name(), r.variance.value,
        1e9 * cost.cost / r.variance.value, ranked ? fmt::format("{:.3g} us", 1e6 * cost.cost) : "-",
        ratio_cell(cost), ranked ? rank_text(cost.rank) : word_of(r.verdict), r.reason.empty() ? "" : ": ",
        r.reason);
  }
  const int roulette = scene.scene.defaults.rr_depth;
  say("{}: {}\n  ({} time, {}, {}x{}, {}; all intervals are right with probability 95%)\n", scene.name,
      answer_of(measured.methods, measured.costs, run.seconds), word_of(run.clock()),
      roulette < 0 ? "no roulette" : fmt::format("roulette from edge {}", roulette), camera.width,
      camera.height, run.device.name);
}

using Report = std::function<void(const std::string& what, double seconds_left)>;

SceneResults measure(const Run& run, const SceneRun& scene, Tables& tables, const Report& report,
                     const std::function<void(const std::string&)>& notice) {
  SceneBenchSettings settings = bench_settings(run.options);
  settings.seconds = run.seconds_left;
  settings.report = report;
  settings.notice = notice;
  SceneBench bench(scene.scene, settings);
  bench.try_methods(tables.results.with_earlier({scene.name}, run.methods, scene.settings));
  const std::filesystem::path file = run.options.folder / "references" / (scene.name + ".exr");
  SceneResults measured{
      saved_reference(file, scene.settings, scene.scene.camera, [&] { return bench.reference(); }), {}, {}};
  measured.methods = bench.measure(measured.reference);
  measured.costs = rank(measured.methods, run.clock());
  write_images(run.options.folder / "scenes-images" / scene.name, scene.scene.camera, measured);
  write_answer(run.options.folder / "scenes.verdict.txt", scene.name,
               answer_of(measured.methods, measured.costs, run.seconds));
  tables.replace(run, scene, measured); // last: a scene in the table is not measured again
  return measured;
}

// ---- All scenes

void check_names(const std::vector<std::filesystem::path>& files) {
  std::map<std::string, std::filesystem::path> seen;
  for (const auto& file : files)
    if (const auto [other, added] = seen.try_emplace(file.stem().string(), file); !added)
      throw UsageError(fmt::format("{}: has the name of {}: tables identify scenes by it: rename one of them",
                                   file.string(), other->second.string()));
}

double seconds_for_each(const ScenesOptions& options, double total, std::size_t scenes) {
  return options.seconds.value_or(
      std::min(options.quick ? quick_seconds : default_seconds, total / static_cast<double>(scenes)));
}

std::string command_of(const ScenesOptions& options) {
  std::string command = "phlux bench scenes";
  if (options.quick) command += " --quick";
  command += text_of_amount(options) + text_of_strategies(options);
  for (const auto& scene : options.scenes) command += " --scene " + scene.string();
  return command;
}

struct Progress {
  std::size_t scenes = 0, programs = 0, programs_built = 0;
};

void measure_all(const Run& run, const std::vector<SceneRun>& scenes, Tables& tables, Progress& progress) {
  StatusLine status;
  std::vector<const SceneRun*> pending;
  for (const SceneRun& scene : scenes)
    if (tables.results.has({scene.name}, run.methods, scene.settings))
      say("{}: measured already\n", scene.name);
    else
      pending.push_back(&scene);
  for (std::size_t i = 0; i < pending.size(); ++i) {
    const SceneRun& scene = *pending[i];
    const double later = run.seconds_left * static_cast<double>(pending.size() - i - 1);
    const auto report = [&](const std::string& what, double left) {
      status.show(fmt::format("scene {} of {}, {}: {}  {} left", i + 1, pending.size(), scene.name, what,
                              clock_text(left + later)));
    };
    const auto notice = [&](const std::string& text) {
      status.clear();
      say("{}: {}\n", scene.name, text);
    };
    const SceneResults measured = measure(run, scene, tables, report, notice);
    status.clear();
    print(run, scene, measured);
    ++progress.scenes;
  }
}

void finish(const Run& run, const Progress& progress) {
  // If nothing was measured now, the saved provenance is still valid.
  if (progress.scenes > 0 || !std::filesystem::exists(run.options.folder / "scenes.provenance.json")) {
    const std::string kernels =
        progress.programs > 0
            ? fmt::format(
                  "{} programs for {} pairs of scene and method were not in the cache; all were built "
                  "before anything was timed",
                  progress.programs_built, progress.programs)
            : "built before anything was timed";
    write_provenance(
        run.options.folder, "scenes",
        {command_of(run.options), run.device, run.lanes, kernels,
         fmt::format("from {} for the rounds, 1000000 more for trials, 2000000 more for references",
                     run.options.seed)});
  }
  draw_charts(run.options.folder, "scenes");
}

} // namespace

bool measure_scenes(const ScenesOptions& options) {
  const std::vector<std::filesystem::path> files = options.scenes.empty() ? shipped_scenes() : options.scenes;
  check_names(files);
  check_scenes(files);
  make_folder(options.folder);
  Tables tables(options.folder);
  Progress progress;
  const Clock::time_point begin = Clock::now();
  const std::vector<Method> methods = all_methods(options.strategies, options.quick);
  if (options.build_ahead && tables.results.empty()) {
    tables.write();
    StatusLine status;
    status.show("building kernels");
    progress.programs = files.size() * methods.size();
    std::vector<std::function<scene::Scene()>> loads;
    for (const auto& file : files) loads.emplace_back([&file] { return scene_file::load(file); });
    progress.programs_built = build_programs(loads, methods, bench_settings(options));
  }
  const device::Device device = device::open_devices(options.devices).front();
  const double total = options.quick ? quick_total : default_total;
  const double seconds = seconds_for_each(options, total, files.size());
  const Run run{options,
                device.info,
                options.lanes_on(device.info),
                methods,
                seconds,
                seconds_left_for_each(options, seconds, total, seconds_since(begin), files.size())};
  std::vector<SceneRun> scenes;
  for (const auto& file : files) scenes.push_back(load(file, run));
  if (!runs_to_end([&] { measure_all(run, scenes, tables, progress); }, options.interrupted)) {
    say("interrupted: the same command resumes with the missing scenes\n");
    return false;
  }
  finish(run, progress);
  say("{}\n", (options.folder / "index.html").string());
  return true;
}

} // namespace phlux::bench
