#include "bench/precision/precision.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "accel/geometry.h"
#include "bench/common/methods/method.h"
#include "bench/common/methods/timed_render.h"
#include "bench/common/report/draw.h"
#include "bench/common/status_line.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/provenance.h"
#include "bench/precision/precision_error.h"
#include "bench/scenes/scene_files.h"
#include "device/device.h"
#include "errors.h"
#include "measure/moments.h"
#include "render/parts.h"
#include "scene_file/load.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

constexpr int rounds = 8, quick_rounds = 4;
constexpr int round_samples = 64, quick_round_samples = 32;
constexpr int largest_side = 24;
constexpr int timings = 5, quick_timings = 3;
constexpr double timing_seconds = 0.25, quick_timing_seconds = 0.1;

// A scene and a method to render in both precisions.
struct Setup {
  const PrecisionOptions& options;
  scene::Scene scene;
  Method method;

  [[nodiscard]] render::Settings settings(int lanes, bool double_precision) const {
    render::Settings settings = settings_of(method, scene.defaults);
    settings.devices = options.devices;
    settings.kernel_dir = options.kernel_dir;
    settings.seed = options.seed;
    settings.lanes = lanes;
    settings.double_precision = double_precision;
    return settings;
  }
};

struct Timing {
  double float32 = 0, float64 = 0; // processor seconds per sample, medians
  double ratio = 0, least = 0, most = 0;
};

// Samples of a light choose its triangles by their order in the hierarchy, which depends on WIDTH. Without a
// hierarchy the order is that of the scene, so that a seed gives the same samples for every WIDTH.
constexpr std::uint64_t most_without_hierarchy = 1000;

// One film per seed.
std::vector<film::Film> render_rounds(const Setup& setup, int lanes, bool double_precision) {
  const bool quick = setup.options.quick;
  render::Settings settings = setup.settings(lanes, double_precision);
  settings.samples_per_pixel = quick ? quick_round_samples : round_samples;
  if (accel::count_primitives(setup.scene) <= most_without_hierarchy)
    settings.traversal = render::Traversal::brute_force;
  MethodRenderer renderer(setup.scene, settings);
  std::vector<film::Film> films;
  for (int round = 0; round < (quick ? quick_rounds : rounds); ++round)
    films.push_back(renderer
                        .render_samples(settings.seed + static_cast<std::uint64_t>(round),
                                        settings.samples_per_pixel, setup.options.interrupted)
                        .film);
  return films;
}

// Renders alternate, so that other load on the machine affects both alike.
Timing time_in_turns(const Setup& setup, int lanes) {
  const bool quick = setup.options.quick;
  const auto seconds_of = [&](MethodRenderer& renderer) {
    return renderer
        .render_for(setup.options.seed, quick ? quick_timing_seconds : timing_seconds, {},
                    setup.options.interrupted)
        .processor_seconds_per_sample;
  };
  MethodRenderer renderer32(setup.scene, setup.settings(lanes, false));
  MethodRenderer renderer64(setup.scene, setup.settings(1, true));
  std::vector<double> float32, float64, ratios;
  for (int i = 0; i < (quick ? quick_timings : timings); ++i) {
    float32.push_back(seconds_of(renderer32));
    float64.push_back(seconds_of(renderer64));
    if (float32.back() > 0 && float64.back() > 0) ratios.push_back(float64.back() / float32.back());
  }
  if (ratios.empty()) return {};
  const auto [least, most] = std::ranges::minmax(ratios);
  return {measure::median(float32), measure::median(float64), measure::median(ratios), least, most};
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : "";
}

std::string row_of(const std::string& scene, const Setup& setup, int lanes, const PrecisionError& error,
                   const Timing& time, const device::DeviceInfo& device) {
  const bool quick = setup.options.quick;
  std::vector<std::string> row = {scene, setup.method.integrator, fmt::format("{}", lanes)};
  for (const double value : {error.variance, error.difference, error.systematic, error.systematic_most,
                             error.mean.value, error.mean.standard_error, error.largest, error.quiet_share,
                             error.quiet_difference, 1e9 * time.float32, 1e9 * time.float64, time.ratio,
                             time.least, time.most, break_even_samples(error.systematic, time.ratio)})
    row.push_back(number(value));
  const scene::Camera& camera = setup.scene.camera;
  row.push_back(
      fmt::format("{}", (quick ? quick_rounds : rounds) * (quick ? quick_round_samples : round_samples)));
  row.push_back(fmt::format("{}x{}", camera.width, camera.height));
  row.push_back(fmt::format("{}", setup.options.seed));
  row.push_back(csv_value(device.name));
  return fmt::format("{}", fmt::join(row, ","));
}

// A scene may need a file that a script beside it generates.
bool can_be_read(const std::filesystem::path& file) try {
  (void)scene_file::load(file);
  return true;
} catch (const SceneError& error) {
  say("left out: {}\n", error.what());
  return false;
}

std::vector<std::filesystem::path> scenes_of(const PrecisionOptions& options) {
  if (!options.scenes.empty()) return options.scenes;
  std::vector<std::filesystem::path> files = shipped_scenes();
  if (options.quick) return files;
  std::vector<std::filesystem::path> stability;
  std::error_code ignored;
  for (const auto& entry :
       std::filesystem::directory_iterator(files.front().parent_path() / "stability", ignored))
    if (entry.path().extension() == ".xml" && can_be_read(entry.path())) stability.push_back(entry.path());
  std::ranges::sort(stability);
  files.insert(files.end(), stability.begin(), stability.end());
  return files;
}

std::vector<Method> methods_of(const PrecisionOptions& options) {
  const std::string strategy = render::Settings().strategy;
  if (options.quick) return {{"path", strategy, "mis"}};
  return {{"path", strategy, "mis"}, {"light", strategy, "-"}, {"bidir", strategy, "balance"}};
}

// The name of the file, with its folder if two files have the same name.
std::string name_of(const std::filesystem::path& file, const std::vector<std::filesystem::path>& files) {
  const auto count =
      std::ranges::count_if(files, [&](const auto& other) { return other.stem() == file.stem(); });
  return count > 1 ? (file.parent_path().filename() / file.stem()).string() : file.stem().string();
}

void print(const std::string& scene, const Method& method, int lanes, const PrecisionError& error,
           const Timing& time) {
  say("{:<20} {:<12} WIDTH {:<3} error of float32 / noise of {:g} samples: {:.2g}, systematic part at "
      "most {:.2g}; {:.2f} times as fast\n",
      scene, method.name(), lanes, unit_samples, error.difference, error.systematic_most, time.ratio);
}

void measure_scene(const PrecisionOptions& options, const std::filesystem::path& file,
                   const std::string& scene, const Method& method, const device::DeviceInfo& device,
                   CsvFile& table, StatusLine& status) {
  const Setup setup{options, load_at_size(file, largest_side), method};
  const int native = options.lanes_on(device);
  std::vector<int> widths = {1};
  if (native != 1) widths.push_back(native);
  try {
    status.show(fmt::format("{}, {} in float64", scene, method.name()));
    const std::vector<film::Film> float64 = render_rounds(setup, 1, true);
    for (const int lanes : widths) {
      status.show(fmt::format("{}, {}, WIDTH {}", scene, method.name(), lanes));
      const PrecisionError error = precision_error(pairs_of(render_rounds(setup, lanes, false), float64));
      const Timing time = time_in_turns(setup, lanes);
      status.clear();
      table.line(row_of(scene, setup, lanes, error, time, device));
      print(scene, method, lanes, error, time);
    }
  } catch (const UsageError& refusal) { // the method cannot render this scene
    status.clear();
    say("{}, {}: {}\n", scene, method.name(), refusal.what());
  }
}

} // namespace

const std::vector<std::string>& precision_columns() {
  static const std::vector<std::string> columns = {"scene",
                                                   "integrator",
                                                   "width",
                                                   "variance_per_sample",
                                                   "difference",
                                                   "systematic",
                                                   "systematic_most",
                                                   "mean_difference",
                                                   "mean_difference_standard_error",
                                                   "largest",
                                                   "quiet_share",
                                                   "quiet_difference",
                                                   "ns_per_sample",
                                                   "ns_per_sample_double",
                                                   "times_as_fast",
                                                   "times_as_fast_least",
                                                   "times_as_fast_most",
                                                   "break_even_samples",
                                                   "samples_per_pixel",
                                                   "image",
                                                   "seed",
                                                   "device"};
  return columns;
}

bool measure_precision(const PrecisionOptions& options) try {
  const std::vector<std::filesystem::path> files = scenes_of(options);
  check_scenes(files);
  CsvFile table(options.folder, "precision.csv", fmt::format("{}", fmt::join(precision_columns(), ",")));
  const device::Device device = device::open_devices(options.devices).front();
  render::Settings float64;
  float64.double_precision = true;
  (void)render::lanes_for(device.info, float64); // throws if the device has no doubles
  StatusLine status;
  for (const Method& method : methods_of(options))
    for (const auto& file : files)
      measure_scene(options, file, name_of(file, files), method, device.info, table, status);
  status.clear();
  say("{}\n", (options.folder / "precision.csv").string());
  const int lanes = options.lanes_on(device.info);
  std::string command =
      fmt::format("phlux bench precision{} --width {}", options.quick ? " --quick" : "", lanes);
  for (const auto& file : options.scenes) command += " --scene " + file.string();
  write_provenance(
      options.folder, "precision",
      {command, device.info, lanes, "built before anything is timed",
       fmt::format("{} to {}", options.seed,
                   options.seed + static_cast<std::uint64_t>(options.quick ? quick_rounds : rounds) - 1)});
  draw_charts(options.folder, "precision");
  return true;
} catch (const Interrupted&) {
  say("interrupted: {} contains the finished rows\n", (options.folder / "precision.csv").string());
  return false;
}

} // namespace phlux::bench
