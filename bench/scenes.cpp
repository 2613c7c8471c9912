#include "bench/scenes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "bench/array_file.h"
#include "bench/build_ahead.h"
#include "bench/csv.h"
#include "bench/draw.h"
#include "bench/provenance.h"
#include "bench/saved_table.h"
#include "bench/scene_bench.h"
#include "bench/scripts.h"
#include "bench/status_line.h"
#include "bench/timed_render.h"
#include "device/device.h"
#include "errors.h"
#include "scene_file/load.h"

namespace phlux::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double default_seconds = 120, quick_seconds = 11; // a scene
constexpr double default_total = 17 * 60, quick_total = 90;
constexpr int default_side = 128, quick_side = 64;

const std::vector<std::string> columns = {"scene",
                                          "integrator",
                                          "strategy",
                                          "connect_or_weights",
                                          "device",
                                          "samples_per_pixel",
                                          "seconds",
                                          "relmse",
                                          "variance_per_sample",
                                          "variance_standard_error",
                                          "top_share",
                                          "seconds_per_sample",
                                          "variance_times_seconds", // the contract's end here
                                          "verdict",
                                          "reason",
                                          "variance_measured",
                                          "variance_measured_standard_error",
                                          "seconds_per_sample_least",
                                          "seconds_per_sample_most",
                                          "processor_seconds_per_sample",
                                          "mean",
                                          "mean_standard_error",
                                          "mean_bias_sigma",
                                          "rounds",
                                          "seed",
                                          "image",
                                          "reference_by",
                                          "reference_relmse",
                                          "reference_seconds",
                                          "lanes",
                                          "settings"};

const std::vector<std::string> convergence_columns = {
    "scene",  "integrator",   "strategy",    "connect_or_weights", "seconds", "samples_per_pixel",
    "relmse", "relmse_least", "relmse_most", "relmse_expected",    "rounds",  "settings"};

// ---- What is the same in two runs

// FNV-1a, 64 bits (Fowler, Noll, Vo): names what was measured, without a claim to be unbreakable.
class Fingerprint {
public:
  void add(const void* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      hash_ = (hash_ ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001b3ull;
  }
  void add(const std::string& text) { add(text.data(), text.size() + 1); }
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", hash_); }

private:
  std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Run { // what all scenes share
  const ScenesOptions& options;
  device::DeviceInfo device;
  int lanes = 0;
  std::vector<Method> methods;
  double seconds = 0;      // a scene
  double seconds_left = 0; // a scene, of what building kernels left
};

struct SceneRun {
  std::string name;
  scene::Scene scene;
  std::string settings; // fingerprint of all that the figures depend on but the method
};

scene::Scene load_at_size(const std::filesystem::path& file, int largest_side) {
  scene::Scene scene = scene_file::load(file);
  scene::Camera& camera = scene.camera;
  const int side = std::max(camera.width, camera.height);
  if (side > largest_side) {
    const auto scaled = [&](int pixels) {
      return std::max(1, static_cast<int>(std::lround(static_cast<double>(pixels) * largest_side / side)));
    };
    camera.width = scaled(camera.width);
    camera.height = scaled(camera.height);
  }
  return scene;
}

SceneRun load(const std::filesystem::path& file, const Run& run) {
  const int side = run.options.largest_side.value_or(run.options.quick ? quick_side : default_side);
  SceneRun result{file.stem().string(), load_at_size(file, side), {}};
  Fingerprint fingerprint;
  fingerprint.add(text_of(file));
  for (const scene::Mesh& mesh : result.scene.meshes)
    fingerprint.add(mesh.positions.data(), mesh.positions.size() * sizeof(scene::Vec3));
  fingerprint.add(fmt::format("{} {} {} {} {} {} {} {}", PHLUX_VERSION, result.scene.camera.width,
                              result.scene.camera.height, run.options.quick, run.seconds, run.options.seed,
                              run.lanes, run.device.name));
  fingerprint.add(run.options.kernel_dir.string());
  result.settings = fingerprint.text();
  return result;
}

// ---- The tables

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : "";
}

std::vector<std::string> row_of(const Run& run, const SceneRun& scene, const ReferenceImage& reference,
                                const MethodResult& result) {
  const Method& m = result.method;
  std::vector<std::string> row = {scene.name, m.integrator, m.strategy, m.variant,
                                  csv_value(run.device.name)};
  const bool refused = result.verdict == Verdict::refused, sound = result.verdict == Verdict::sound;
  const auto figure = [&](double value, bool earned = true) {
    row.push_back(refused || !earned ? "" : number(value));
  };
  const ConvergencePoint end = refused ? ConvergencePoint{} : result.convergence.back();
  figure(end.samples_per_pixel);
  figure(end.seconds);
  figure(end.relmse);
  const bool variance_known = result.verdict != Verdict::suspect_variance;
  figure(result.variance.value, variance_known);
  figure(result.variance.standard_error, variance_known);
  figure(result.top_share);
  figure(result.seconds_per_sample);
  figure(result.variance.value * result.seconds_per_sample, sound);
  row.push_back(word_of(result.verdict));
  row.push_back(csv_value(result.reason));
  figure(result.variance.value);
  figure(result.variance.standard_error);
  figure(result.seconds_per_sample_least);
  figure(result.seconds_per_sample_most);
  figure(result.processor_seconds_per_sample);
  figure(result.mean.value);
  figure(result.mean.standard_error);
  figure(result.mean_bias_sigma);
  const scene::Camera& camera = scene.scene.camera;
  for (const std::string& text :
       {fmt::format("{}", result.rounds), fmt::format("{}", run.options.seed),
        fmt::format("{}x{}", camera.width, camera.height), csv_value(reference.method),
        number(reference.relmse), number(reference.seconds), fmt::format("{}", run.lanes), scene.settings})
    row.push_back(text);
  return row;
}

std::vector<std::string> convergence_row(const SceneRun& scene, const ReferenceImage& reference,
                                         const MethodResult& result, const ConvergencePoint& point) {
  const Method& m = result.method;
  std::vector<std::string> row = {scene.name, m.integrator, m.strategy, m.variant};
  for (const double value :
       {point.seconds, point.samples_per_pixel, point.relmse, point.relmse_least, point.relmse_most,
        result.variance.value / point.samples_per_pixel + reference.relmse})
    row.push_back(number(value));
  row.push_back(fmt::format("{}", point.rounds));
  row.push_back(scene.settings);
  return row;
}

struct Tables {
  explicit Tables(const std::filesystem::path& folder)
      : results(folder, "scenes.csv", columns),
        convergence(folder, "scenes-convergence.csv", convergence_columns) {}

  [[nodiscard]] bool has(const SceneRun& scene, const Method& m) const {
    return std::ranges::any_of(results.rows(), [&](const SavedTable::Row& row) {
      return row[0] == scene.name && Method{row[1], row[2], row[3]} == m && row.back() == scene.settings &&
             results.value(row, "verdict") != word_of(Verdict::refused);
    });
  }
  // What other settings gave, and what is measured anew.
  void forget(const SceneRun& scene, const std::vector<Method>& again) {
    const auto unwanted = [&](const SavedTable::Row& row) {
      return row[0] == scene.name &&
             (row.back() != scene.settings || std::ranges::count(again, Method{row[1], row[2], row[3]}) > 0);
    };
    results.remove_if(unwanted);
    convergence.remove_if(unwanted);
  }
  void write() const {
    convergence.write();
    results.write(); // last: what it has is there in full
  }

  SavedTable results, convergence;
};

// ---- One scene

std::string file_name(const Method& m) {
  return fmt::format("{}-{}-{}.npy", m.integrator, m.variant == "-" ? "all" : m.variant, m.strategy);
}

void write_images(const std::filesystem::path& folder, const scene::Camera& camera,
                  const ReferenceImage& reference, const std::vector<MethodResult>& results) {
  make_folder(folder);
  const std::vector<std::size_t> shape = {static_cast<std::size_t>(camera.height),
                                          static_cast<std::size_t>(camera.width), 3};
  write_array(folder / "reference.npy", shape, reference.radiance);
  for (const MethodResult& result : results)
    if (result.verdict != Verdict::refused)
      write_array(folder / file_name(result.method), shape, result.first_image.radiance);
}

void print(const SceneRun& scene, const ReferenceImage& reference, const std::vector<MethodResult>& results) {
  fmt::print("{}, {}x{}; reference by {}, {:.0f} samples per pixel, relative MSE {:.2g}\n", scene.name,
             scene.scene.camera.width, scene.scene.camera.height, reference.method,
             reference.samples_per_pixel, reference.relmse);
  fmt::print("  {:<28} {:>12} {:>10} {:>14} {:>10}  {}\n", "method", "variance", "ns/sample", "to variance 1",
             "top 0.1%", "");
  for (const MethodResult& r : results) {
    if (r.verdict == Verdict::refused) {
      fmt::print("  {:<28} {}: {}\n", r.method.name(), word_of(r.verdict), r.reason);
      continue;
    }
    const bool sound = r.verdict == Verdict::sound;
    fmt::print("  {:<28} {:>12} {:>10.1f} {:>14} {:>9.1f}%  {}{}{}\n", r.method.name(),
               fmt::format("{:.4g}", r.variance.value), 1e9 * r.seconds_per_sample,
               sound ? fmt::format("{:.3g} us", 1e6 * r.variance.value * r.seconds_per_sample) : "-",
               100 * r.top_share, sound ? "" : word_of(r.verdict), sound ? "" : ": ", sound ? "" : r.reason);
  }
  std::fflush(stdout);
}

ReferenceImage reference_of(const SceneBench& bench, const SceneRun& scene,
                            const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / (scene.name + ".exr");
  if (auto saved = read_reference(file, scene.settings)) return *saved;
  const ReferenceImage reference = bench.reference();
  make_folder(folder);
  write_reference(file, scene.settings, reference, scene.scene.camera);
  return reference;
}

struct SceneResults {
  ReferenceImage reference;
  std::vector<MethodResult> methods;
};

SceneResults measure(const Run& run, const SceneRun& scene, const std::vector<Method>& methods,
                     Tables& tables, const std::function<void(const std::string&)>& report) {
  SceneBenchSettings settings;
  settings.devices = run.options.devices;
  settings.lanes = run.options.lanes;
  settings.kernel_dir = run.options.kernel_dir;
  settings.seed = run.options.seed;
  settings.seconds = run.seconds_left;
  settings.least_rounds = run.options.quick ? 5 : 10;
  settings.trial_renders = run.options.quick ? 3 : 6;
  settings.interrupted = run.options.interrupted;
  settings.report = report;
  SceneBench bench(scene.scene, settings);
  bench.try_methods(methods);
  ReferenceImage reference = reference_of(bench, scene, run.options.folder / "references");
  const std::vector<MethodResult> results = bench.measure(reference);
  // The reference's own renders may all have missed what the rounds met.
  for (const MethodResult& result : results)
    if (result.method.name() == reference.method)
      reference.relmse = std::max(reference.relmse, result.variance.value / reference.samples_per_pixel);
  write_images(run.options.folder / "scenes-images" / scene.name, scene.scene.camera, reference, results);
  tables.forget(scene, methods);
  for (const MethodResult& result : results) {
    tables.results.add(row_of(run, scene, reference, result));
    for (const ConvergencePoint& point : result.convergence)
      tables.convergence.add(convergence_row(scene, reference, result, point));
  }
  tables.write();
  return {reference, results};
}

// ---- All scenes

void check_names(const std::vector<std::filesystem::path>& files) {
  std::map<std::string, std::filesystem::path> seen;
  for (const auto& file : files)
    if (const auto [other, added] = seen.try_emplace(file.stem().string(), file); !added)
      throw UsageError(fmt::format("--scene {}: has the name of {}: tables tell scenes by it", file.string(),
                                   other->second.string()));
}

double seconds_for_each(const ScenesOptions& options, std::size_t scenes) {
  const double total = options.quick ? quick_total : default_total;
  return options.seconds.value_or(
      std::min(options.quick ? quick_seconds : default_seconds, total / static_cast<double>(scenes)));
}

// Asked for a time, scenes get it; else building kernels is a part of what all may take.
double seconds_left_for_each(const ScenesOptions& options, double seconds, double building,
                             std::size_t scenes) {
  if (options.seconds) return seconds;
  const double total = options.quick ? quick_total : default_total;
  return std::clamp((total - building) / static_cast<double>(scenes), seconds / 4, seconds);
}

std::string command_of(const ScenesOptions& options) {
  std::string command = "phlux bench scenes";
  if (options.quick) command += " --quick";
  if (options.seconds) command += fmt::format(" --seconds {}", *options.seconds);
  if (options.largest_side) command += fmt::format(" --side {}", *options.largest_side);
  if (options.lanes != 0) command += fmt::format(" --width {}", options.lanes);
  if (options.seed != 1) command += fmt::format(" --seed {}", options.seed);
  if (options.strategies != std::vector<std::string>{"exact"})
    for (const std::string& strategy : options.strategies) command += " --strategy " + strategy;
  for (const auto& scene : options.scenes) command += " --scene " + scene.filename().string();
  return command;
}

std::vector<Method> missing(const Run& run, const SceneRun& scene, const Tables& tables) {
  std::vector<Method> methods;
  for (const Method& method : run.methods)
    if (!tables.has(scene, method)) methods.push_back(method);
  // Those that refuse are asked again at no cost; alone they are no reason to measure.
  const bool only_refusals = std::ranges::all_of(methods, [&](const Method& m) {
    return std::ranges::any_of(tables.results.rows(), [&](const SavedTable::Row& row) {
      return row[0] == scene.name && Method{row[1], row[2], row[3]} == m && row.back() == scene.settings;
    });
  });
  return only_refusals ? std::vector<Method>{} : methods;
}

// The programs of all scenes and methods, built or found in the cache; returns how many were built.
std::size_t build_kernels(const ScenesOptions& options, const std::vector<std::filesystem::path>& files,
                          const std::vector<Method>& methods) {
  std::vector<std::function<std::size_t()>> jobs;
  for (const auto& file : files)
    for (const Method& method : methods)
      jobs.emplace_back([&options, &file, &method]() -> std::size_t {
        const scene::Scene scene = load_at_size(file, 1);
        render::Settings settings = settings_of(method, scene.defaults);
        settings.devices = options.devices;
        settings.lanes = options.lanes;
        settings.kernel_dir = options.kernel_dir;
        settings.samples_per_pixel = 1;
        film::Film film(scene.camera.width, scene.camera.height);
        try {
          return render::render(scene, settings, film, {}).kernels_from_cache ? 0 : 1;
        } catch (const Error&) {
          return 0;
        }
      });
  return run_in_children(jobs);
}

struct Measured {
  std::size_t scenes = 0, programs = 0, programs_built = 0;
};

void measure_all(const Run& run, const std::vector<SceneRun>& scenes, Tables& tables, Measured& measured) {
  StatusLine status;
  std::vector<std::vector<Method>> methods_of;
  for (const SceneRun& scene : scenes) methods_of.push_back(missing(run, scene, tables));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const std::vector<Method>& methods = methods_of[i];
    if (methods.empty()) {
      fmt::print("{}: measured already\n", scenes[i].name);
      continue;
    }
    const Clock::time_point begin = Clock::now();
    const auto later = std::count_if(methods_of.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                     methods_of.end(), [](const auto& those) { return !those.empty(); });
    const SceneResults results = measure(run, scenes[i], methods, tables, [&](const std::string& what) {
      const double spent = std::chrono::duration<double>(Clock::now() - begin).count();
      const double left =
          std::max(0.0, run.seconds_left - spent) + run.seconds_left * static_cast<double>(later);
      status.show(fmt::format("scene {} of {}, {}: {}  {} left", i + 1, scenes.size(), scenes[i].name, what,
                              clock_text(left)));
    });
    status.clear();
    print(scenes[i], results.reference, results.methods);
    ++measured.scenes;
  }
}

void finish(const Run& run, const Measured& measured) {
  // Where nothing was measured, what is there says how it was.
  if (measured.scenes > 0 || !std::filesystem::exists(run.options.folder / "scenes.provenance.json")) {
    const std::string kernels =
        measured.programs > 0
            ? fmt::format("{} programs of {} scenes and methods were not in the cache; all were built before "
                          "anything was timed",
                          measured.programs_built, measured.programs)
            : "built before anything was timed";
    write_provenance(run.options.folder, "scenes",
                     {command_of(run.options), run.device, run.lanes, kernels,
                      fmt::format("{} and up for the rounds, from 1000000 above for trials, from 2000000 "
                                  "above for references",
                                  run.options.seed)});
  }
  draw_charts(run.options.folder, scenes_script());
}

bool stopped() {
  fmt::print("interrupted: the same command goes on with the scenes that are missing\n");
  return false;
}

} // namespace

std::vector<std::filesystem::path> shipped_scenes() {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  for (const std::filesystem::path& folder :
       {std::filesystem::path("scenes"), program.parent_path().parent_path() / "scenes"}) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
      if (entry.path().extension() == ".xml") files.push_back(entry.path());
    std::ranges::sort(files);
    if (!files.empty()) return files;
  }
  throw UsageError("no folder scenes/ here with scenes that ship: name some with --scene FILE.xml");
}

bool measure_scenes(const ScenesOptions& options) {
  const std::vector<std::filesystem::path> files = options.scenes.empty() ? shipped_scenes() : options.scenes;
  check_names(files);
  for (const auto& file : files)
    (void)scene_file::load(file); // bad ones are errors before minutes have passed
  make_folder(options.folder);
  Tables tables(options.folder);
  Measured measured;
  const Clock::time_point begin = Clock::now();
  const std::vector<Method> methods = all_methods(options.strategies, options.quick);
  if (options.build_ahead && tables.results.rows().empty()) {
    tables.write();
    StatusLine status;
    status.show("building kernels");
    measured.programs = files.size() * methods.size();
    measured.programs_built = build_kernels(options, files, methods);
  }
  const device::Device device = device::open_devices(options.devices).front();
  const double seconds = seconds_for_each(options, files.size());
  const double building = std::chrono::duration<double>(Clock::now() - begin).count();
  const Run run{options, device.info, options.lanes != 0 ? options.lanes : device.info.lanes,
                methods, seconds,     seconds_left_for_each(options, seconds, building, files.size())};
  std::vector<SceneRun> scenes;
  for (const auto& file : files) scenes.push_back(load(file, run));
  try {
    measure_all(run, scenes, tables, measured);
  } catch (const Interrupted&) {
    return stopped();
  } catch (const DeviceError&) { // a compiler gives up, too, when it is interrupted
    if (options.interrupted && options.interrupted()) return stopped();
    throw;
  }
  finish(run, measured);
  fmt::print("{}\n", (options.folder / "index.html").string());
  return true;
}

} // namespace phlux::bench
