#include "bench/precision/precision.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "accel/geometry.h"
#include "bench/common/methods/method.h"
#include "bench/common/methods/timed_render.h"
#include "bench/common/moments.h"
#include "bench/common/report/draw.h"
#include "bench/common/report/scripts.h"
#include "bench/common/status_line.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/provenance.h"
#include "bench/scenes/scenes.h"
#include "device/device.h"
#include "errors.h"
#include "render/parts.h"
#include "scene_file/load.h"

namespace phlux::bench {
namespace {

constexpr int rounds = 8, quick_rounds = 4;
constexpr int round_samples = 64, quick_round_samples = 32;
constexpr int largest_side = 24;
constexpr int timings = 5, quick_timings = 3;
constexpr double timing_seconds = 0.25, quick_timing_seconds = 0.1;
constexpr double darkness = 1e-2;    // below, an error counts as relative to this, as in files::compare
constexpr double least_noise = 1e-6; // relative: below, a value is as good as without

// What is rendered, in one of the precisions.
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
  double single = 0, in_double = 0; ///< processor seconds of a sample: medians
  double ratio = 0, least = 0, most = 0;
};

// Triangles of a light stand in the order of the hierarchy, which WIDTH decides, and are chosen by it: in
// another order a seed gives other samples. Without a hierarchy the order is the scene's.
constexpr std::uint64_t most_without_hierarchy = 1000;

// An image for each seed.
std::vector<film::Film> render_rounds(const Setup& setup, int lanes, bool double_precision) {
  const bool quick = setup.options.quick;
  render::Settings settings = setup.settings(lanes, double_precision);
  settings.samples_per_pixel = quick ? quick_round_samples : round_samples;
  if (accel::count_primitives(setup.scene) <= most_without_hierarchy)
    settings.traversal = render::Traversal::brute_force;
  std::vector<film::Film> films;
  for (int round = 0; round < (quick ? quick_rounds : rounds); ++round, ++settings.seed)
    films.push_back(render_samples(setup.scene, settings, setup.options.interrupted));
  return films;
}

// In turns, as what else the machine does comes and goes.
Timing time_in_turns(const Setup& setup, int lanes) {
  const bool quick = setup.options.quick;
  const auto seconds_of = [&](const render::Settings& settings) {
    return render_for(setup.scene, settings, quick ? quick_timing_seconds : timing_seconds, {},
                      setup.options.interrupted)
        .processor_seconds_per_sample;
  };
  std::vector<double> single, in_double, ratios;
  for (int i = 0; i < (quick ? quick_timings : timings); ++i) {
    single.push_back(seconds_of(setup.settings(lanes, false)));
    in_double.push_back(seconds_of(setup.settings(1, true)));
    if (single.back() > 0 && in_double.back() > 0) ratios.push_back(in_double.back() / single.back());
  }
  if (ratios.empty()) return {};
  const auto [least, most] = std::ranges::minmax(ratios);
  return {median(single), median(in_double), median(ratios), least, most};
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
                             error.quiet_difference, 1e9 * time.single, 1e9 * time.in_double, time.ratio,
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

// A scene may want a file that a script beside it makes.
bool can_be_read(const std::filesystem::path& file) try {
  (void)scene_file::load(file);
  return true;
} catch (const SceneError& error) {
  fmt::print("left out: {}\n", error.what());
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

// The file's name, with its folder's where there are two of one name.
std::string name_of(const std::filesystem::path& file, const std::vector<std::filesystem::path>& files) {
  const auto count =
      std::ranges::count_if(files, [&](const auto& other) { return other.stem() == file.stem(); });
  return count > 1 ? (file.parent_path().filename() / file.stem()).string() : file.stem().string();
}

void print(const std::string& scene, const Method& method, int lanes, const PrecisionError& error,
           const Timing& time) {
  fmt::print("{:<20} {:<12} WIDTH {:<3} error of float32 {:.2g} of the noise of {:g} samples, systematic at "
             "most {:.2g}"
             "; {:.2f} times as fast\n",
             scene, method.name(), lanes, error.difference, unit_samples, error.systematic_most, time.ratio);
  std::fflush(stdout);
}

void measure_scene(const PrecisionOptions& options, const std::filesystem::path& file,
                   const std::string& scene, const Method& method, const device::DeviceInfo& device,
                   CsvFile& table, StatusLine& status) {
  const Setup setup{options, load_at_size(file, largest_side), method};
  const int native = options.lanes_on(device);
  std::vector<int> widths = {1};
  if (native != 1) widths.push_back(native);
  try {
    status.show(fmt::format("{}, {} in double", scene, method.name()));
    const std::vector<film::Film> in_double = render_rounds(setup, 1, true);
    for (const int lanes : widths) {
      status.show(fmt::format("{}, {}, WIDTH {}", scene, method.name(), lanes));
      const PrecisionError error = precision_error(pairs_of(render_rounds(setup, lanes, false), in_double));
      const Timing time = time_in_turns(setup, lanes);
      status.clear();
      table.line(row_of(scene, setup, lanes, error, time, device));
      print(scene, method, lanes, error, time);
    }
  } catch (const UsageError& refusal) { // the method is not for this scene
    status.clear();
    fmt::print("{}, {}: {}\n", scene, method.name(), refusal.what());
  }
}

} // namespace

PrecisionPairs pairs_of(const std::vector<film::Film>& single, const std::vector<film::Film>& in_double) {
  PrecisionPairs pairs;
  for (const film::Film& film : single) pairs.single.push_back(estimate_of(film));
  for (const film::Film& film : in_double) pairs.in_double.push_back(estimate_of(film));
  const auto count = static_cast<double>(in_double.size());
  for (std::size_t value = 0; value < 3 * in_double.front().pixels().size(); ++value) {
    double sum = 0;
    for (const film::Film& film : in_double) sum += film.variance_of_mean(value / 3)[value % 3];
    pairs.variance.push_back(sum / (count * count));
  }
  return pairs;
}

PrecisionError precision_error(const PrecisionPairs& pairs) {
  const ImageEstimate truth = pooled(pairs.in_double);
  const Reference& reference = truth.radiance;
  // What a pair differs by, on top of the truth: repeats of an image whose noise is that of samples that took
  // another way, and whose bias is float32's.
  std::vector<ImageEstimate> shifted = pairs.single;
  for (std::size_t i = 0; i < shifted.size(); ++i)
    for (std::size_t value = 0; value < reference.size(); ++value)
      shifted[i].radiance[value] += reference[value] - pairs.in_double[i].radiance[value];

  PrecisionError error;
  error.variance = variance_per_sample(pairs.in_double, reference).value;
  const double unit = error.variance / unit_samples;
  const auto in_units = [&](double mse) { return unit > 0 ? std::sqrt(std::max(mse, 0.0) / unit) : 0.0; };
  const Figure systematic = unexplained_mse(shifted, reference);
  error.systematic = in_units(systematic.value);
  error.systematic_most = in_units(systematic.value + 2 * systematic.standard_error);
  error.difference = in_units(std::max(systematic.value, 0.0) +
                              variance_per_sample(shifted, reference).value / unit_samples);
  double mean = 0;
  for (const double value : reference) mean += value / static_cast<double>(reference.size());
  const Figure shifted_mean = image_mean(shifted);
  if (mean > 0) error.mean = {shifted_mean.value / mean - 1, shifted_mean.standard_error / mean};

  const ImageEstimate all = pooled(shifted);
  double quiet = 0;
  for (std::size_t value = 0; value < reference.size(); ++value) {
    const double d = std::abs(all.radiance[value] - reference[value]);
    const double scale = std::hypot(reference[value], darkness);
    const double sigma = std::sqrt(pairs.variance[value] * truth.samples[value / 3] / unit_samples);
    const bool noisy = sigma > least_noise * scale;
    if (noisy) error.largest = std::max(error.largest, d / sigma);
    if (!noisy) error.quiet_difference = std::max(error.quiet_difference, d / scale);
    quiet += noisy ? 0 : 1;
  }
  error.quiet_share = quiet / static_cast<double>(reference.size());
  return error;
}

// systematic^2 V / unit_samples + V / (times_as_fast n) = V / n, for the n at hand.
double break_even_samples(double systematic, double times_as_fast) {
  if (times_as_fast <= 1) return 0;
  if (systematic <= 0) return std::numeric_limits<double>::infinity();
  return unit_samples * (1 - 1 / times_as_fast) / (systematic * systematic);
}

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
  for (const auto& file : files)
    (void)scene_file::load(file); // bad ones are errors before minutes have passed
  CsvFile table(options.folder, "precision.csv", fmt::format("{}", fmt::join(precision_columns(), ",")));
  const device::Device device = device::open_devices(options.devices).front();
  render::Settings in_double;
  in_double.double_precision = true;
  (void)render::lanes_for(device.info, in_double); // or says that there are none
  StatusLine status;
  for (const Method& method : methods_of(options))
    for (const auto& file : files)
      measure_scene(options, file, name_of(file, files), method, device.info, table, status);
  status.clear();
  fmt::print("{}\n", (options.folder / "precision.csv").string());
  std::fflush(stdout);
  const int lanes = options.lanes_on(device.info);
  std::string command =
      fmt::format("phlux bench precision{} --width {}", options.quick ? " --quick" : "", lanes);
  for (const auto& file : options.scenes) command += " --scene " + file.filename().string();
  write_provenance(
      options.folder, "precision",
      {command, device.info, lanes, "built before anything is timed",
       fmt::format("{} to {}", options.seed,
                   options.seed + static_cast<std::uint64_t>(options.quick ? quick_rounds : rounds) - 1)});
  draw_charts(options.folder, precision_script());
  return true;
} catch (const Interrupted&) {
  fmt::print("interrupted: {} has what was measured\n", (options.folder / "precision.csv").string());
  return false;
}

} // namespace phlux::bench
