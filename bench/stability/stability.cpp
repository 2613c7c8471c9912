#include "bench/stability/stability.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/common/methods/build_ahead.h"
#include "bench/common/methods/result_table.h"
#include "bench/common/report/draw.h"
#include "bench/common/status_line.h"
#include "bench/common/tables/array_file.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/fingerprint.h"
#include "bench/common/tables/provenance.h"
#include "bench/stability/stability_scene.h"
#include "clock.h"
#include "device/device.h"
#include "scene/digest.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

constexpr double default_seconds = 20, quick_seconds = 10; // per cell
constexpr double default_total = 13 * 60, quick_total = 90;
constexpr int default_side = 48, quick_side = 32;
constexpr double reference_share = 0.15; // of the time of a cell
// In every cell bidir balance has an efficient technique for each kind of path.
const Method reference_method{"bidir", "exact", "balance"};

std::vector<Method> methods_of(const StabilityOptions& options) {
  std::vector<Method> methods = all_methods(options.strategies, options.quick && options.variants.empty());
  if (!options.variants.empty())
    std::erase_if(methods, [&](Method method) {
      method.strategy = reference_method.strategy;
      return std::ranges::count(options.variants, method.name()) == 0;
    });
  return methods;
}

struct Run { // settings of all cells
  const StabilityOptions& options;
  device::DeviceInfo device;
  int lanes = 0, side = 0;
  std::vector<Method> methods;
  double seconds = 0;      // per cell
  double seconds_left = 0; // per cell, after building kernels

  [[nodiscard]] CommonValues common_values() const {
    return {device.name, lanes, options.seed, clock_of(device)};
  }
};

struct CellRun {
  ResultTable::Values key;
  scene::Scene scene;
  std::string settings; // fingerprint of everything that the results depend on, except the method

  [[nodiscard]] std::string name() const { return fmt::format("n{}-r{}", key[0], key[1]); }
  [[nodiscard]] std::string title() const { return fmt::format("n {}, light radius {}", key[0], key[1]); }
};

CellRun cell_run(const Run& run, const StabilityCell& cell) {
  CellRun result{{number_text(cell.exponent), number_text(cell.light_radius)},
                 stability_scene(cell.exponent, cell.light_radius, run.side),
                 {}};
  Fingerprint fingerprint;
  fingerprint.add(scene::digest(result.scene));
  fingerprint.add(fmt::format("{} {} {} {} {} {} {}", PHLUX_VERSION, run.options.quick, run.seconds,
                              run.options.seed, run.lanes, run.device.name, run.options.kernel_dir.string()));
  result.settings = fingerprint.text();
  return result;
}

// ---- One cell

ReferenceImage reference_of(const CellRun& cell, const SceneBenchSettings& settings,
                            const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / ("stability-" + cell.name() + ".exr");
  return saved_reference(file, cell.settings, cell.scene.camera, [&] {
    if (settings.report) settings.report("reference by " + reference_method.name(), settings.seconds);
    MethodRenderer renderer(cell.scene, render_settings(reference_method, cell.scene, settings));
    return make_reference(renderer, reference_method, cell.scene.camera, settings.seed,
                          std::max(reference_share * settings.seconds, 0.25), settings.interrupted);
  });
}

void write_image(const std::filesystem::path& folder, const CellRun& cell, const ReferenceImage& reference) {
  make_folder(folder);
  const auto side = static_cast<std::size_t>(cell.scene.camera.width);
  write_array(folder / (cell.name() + ".npy"), {side, side, 3}, reference.image.radiance);
}

using Report = std::function<void(const std::string& what, double seconds_left)>;

void measure(const Run& run, const CellRun& cell, ResultTable& table, StatusLine& status,
             const Report& report) {
  const Clock::time_point begin = Clock::now();
  SceneBenchSettings settings = bench_settings(run.options);
  settings.seconds = run.seconds_left;
  settings.report = report;
  ReferenceImage reference = reference_of(cell, settings, run.options.folder / "references");
  settings.seconds = std::max(0.0, run.seconds_left - seconds_since(begin));
  SceneBench bench(cell.scene, settings);
  bench.try_methods(table.with_earlier(cell.key, run.methods, cell.settings));
  const std::vector<MethodResult> results = bench.measure(reference);
  const std::vector<RankedCost> costs = rank(results, run.common_values().clock);
  write_image(run.options.folder / "stability-images", cell, reference);
  table.remove(cell.key);
  for (std::size_t i = 0; i < results.size(); ++i)
    table.add(cell.key, results[i].method,
              result_values(results[i], costs[i], reference, cell.scene.camera, run.common_values()),
              cell.settings);
  table.write();
  status.clear();
  say("{}: {}\n", cell.title(), answer_of(results, costs, run.seconds));
}

// ---- All cells

void measure_all(const Run& run, const std::vector<CellRun>& cells, ResultTable& table) {
  StatusLine status;
  std::vector<const CellRun*> pending;
  for (const CellRun& cell : cells)
    if (!table.has(cell.key, run.methods, cell.settings)) pending.push_back(&cell);
  if (pending.size() < cells.size())
    say("{} of {} cells are measured already\n", cells.size() - pending.size(), cells.size());
  for (std::size_t i = 0; i < pending.size(); ++i) {
    const double later = run.seconds_left * static_cast<double>(pending.size() - i - 1);
    measure(run, *pending[i], table, status, [&](const std::string& what, double left) {
      status.show(fmt::format("cell {} of {}, {}: {}  {} left", i + 1, pending.size(), pending[i]->title(),
                              what, clock_text(left + later)));
    });
  }
}

std::string command_of(const StabilityOptions& options) {
  std::string command = "phlux bench stability";
  if (options.quick) command += " --quick";
  for (const StabilityCell& cell : options.cells)
    command += fmt::format(" --cell {},{}", number_text(cell.exponent), number_text(cell.light_radius));
  for (const std::string& variant : options.variants) command += fmt::format(" --method '{}'", variant);
  return command + text_of_strategies(options) + text_of_amount(options);
}

// The program is the same in all cells, which differ only in numbers.
void build_kernels(const StabilityOptions& options, const StabilityCell& cell,
                   const std::vector<Method>& methods) {
  StatusLine status;
  status.show("building kernels");
  std::vector<Method> all = methods;
  if (std::ranges::count(all, reference_method) == 0) all.push_back(reference_method);
  (void)build_programs({[&] { return stability_scene(cell.exponent, cell.light_radius, 1); }}, all,
                       bench_settings(options));
}

} // namespace

std::vector<StabilityCell> stability_cells(bool quick) {
  const std::vector<double> exponents =
      quick ? std::vector<double>{1, 100, 1e4} : std::vector<double>{1, 10, 100, 1e3, 1e4, 1e5};
  const std::vector<double> radii =
      quick ? std::vector<double>{.3, .03, .003} : std::vector<double>{.3, .1, .03, .01, .003, .001};
  std::vector<StabilityCell> cells;
  for (const double exponent : exponents)
    for (const double radius : radii) cells.push_back({exponent, radius});
  return cells;
}

std::vector<std::string> stability_method_names() {
  std::vector<std::string> names;
  for (const Method& method : all_methods({reference_method.strategy}, false)) names.push_back(method.name());
  return names;
}

bool measure_stability(const StabilityOptions& options) {
  const std::vector<StabilityCell> cells =
      options.cells.empty() ? stability_cells(options.quick) : options.cells;
  const std::vector<Method> methods = methods_of(options);
  make_folder(options.folder);
  ResultTable table(options.folder, "stability.csv", {"exponent", "light_radius"}, result_columns());
  const Clock::time_point begin = Clock::now();
  if (options.build_ahead && table.empty()) {
    table.write();
    build_kernels(options, cells.front(), methods);
  }
  const device::Device device = device::open_devices(options.devices).front();
  const double seconds = options.seconds.value_or(options.quick ? quick_seconds : default_seconds);
  const Run run{options,
                device.info,
                options.lanes_on(device.info),
                options.side.value_or(options.quick ? quick_side : default_side),
                methods,
                seconds,
                seconds_left_for_each(options, seconds, options.quick ? quick_total : default_total,
                                      seconds_since(begin), cells.size())};
  std::vector<CellRun> runs;
  for (const StabilityCell& cell : cells) runs.push_back(cell_run(run, cell));
  if (!runs_to_end([&] { measure_all(run, runs, table); }, options.interrupted)) {
    say("interrupted: the same command resumes with the missing cells\n");
    return false;
  }
  write_provenance(options.folder, "stability",
                   {command_of(options), device.info, run.lanes, "built before anything was timed",
                    fmt::format("from {} for the rounds, 2000000 more for references", options.seed)});
  draw_charts(options.folder, "stability");
  say("{}\n", (options.folder / "index.html").string());
  return true;
}

} // namespace phlux::bench
