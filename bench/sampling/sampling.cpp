#include "bench/sampling/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/common/moments.h"
#include "bench/common/report/draw.h"
#include "bench/common/report/scripts.h"
#include "bench/common/status_line.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/provenance.h"
#include "bench/common/tables/saved_table.h"
#include "bench/common/tables/settings.h"
#include "bench/sampling/sampling_table.h"
#include "clock.h"
#include "render/render.h"

namespace phlux::bench {
namespace {

constexpr int least_rounds = 5;
constexpr std::uint64_t largest_launch = std::uint64_t{1} << 23; // samples; the kernel counts in 32 bits
constexpr double proposals_for_full_count = 16; // beyond, `rejection` gets fewer samples by default

constexpr std::array<const char*, 2> tables = {"sampling.csv", "sampling-no-roulette.csv"};

bool left_out(const std::string& strategy, const Case& one) {
  return strategy == "rejection" && rejection_proposals(one) > most_proposals;
}

std::uint64_t samples_of(const SamplingOptions& options, const std::string& strategy, const Case& one) {
  if (options.samples) return *options.samples;
  const std::uint64_t full = std::uint64_t{1} << (options.quick ? 18 : 19);
  if (strategy != "rejection") return full;
  const double share = std::min(1.0, proposals_for_full_count / rejection_proposals(one));
  return static_cast<std::uint64_t>(static_cast<double>(full) * share);
}

std::uint64_t launch_of(const std::string& strategy, const Case& one, std::uint64_t samples) {
  double most = static_cast<double>(largest_launch);
  if (strategy == "rejection") most *= std::min(1.0, proposals_for_full_count / rejection_proposals(one));
  return std::clamp<std::uint64_t>(samples / least_rounds, 1, static_cast<std::uint64_t>(most));
}

// What is measured together: every strategy in one case under one kind of light.
struct Unit {
  Case one;
  Light light = Light::constant;
  std::uint32_t number = 0;
};

std::vector<std::string> strategies_of(const SamplingOptions& options) {
  return options.strategies.empty() ? render::strategy_names() : options.strategies;
}

std::vector<Case> cases_of(const SamplingOptions& options) {
  return options.cases.empty() ? sampling_cases(options.quick) : options.cases;
}

std::vector<Light> lights_of(const SamplingOptions& options) {
  if (!options.lights.empty()) return options.lights;
  return {Light::constant, Light::mirror_disk, Light::horizon_sky};
}

std::vector<Unit> units_of(const std::vector<Case>& cases, const std::vector<Light>& lights) {
  std::vector<Unit> units;
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (const Light light : lights)
      units.push_back(
          {cases[i], light,
           static_cast<std::uint32_t>(i * light_names().size() + static_cast<std::size_t>(light))});
  return units;
}

// A row in the making.
struct Work {
  Sampler* sampler;
  std::size_t table; // of `tables`
  SamplingRow row;
  std::uint64_t wanted, launch;
  std::uint32_t first = 0;

  [[nodiscard]] bool done() const {
    return row.run.sums.count >= wanted && row.nanoseconds.size() >= least_rounds;
  }
};

std::vector<Work> work_of(std::vector<Sampler>& samplers, const Unit& unit, const SamplingOptions& options) {
  constexpr cl_uint most_rows = 64; // of one unit: each has a seed of its own
  const double reflected = reflected_radiance(unit.one, unit.light);
  std::vector<Work> work;
  for (const std::size_t table : {0u, 1u})
    for (Sampler& sampler : samplers) {
      const std::string& strategy = sampler.strategy();
      const bool absorbs = has_roulette(strategy);
      if (left_out(strategy, unit.one) || (table == 1 && !absorbs)) continue;
      const std::uint64_t wanted = samples_of(options, strategy, unit.one);
      const cl_uint2 seed = {{options.seed, unit.number * most_rows + static_cast<cl_uint>(work.size())}};
      const Subject subject{unit.one, unit.light, absorbs && table == 0, reflected, seed};
      work.push_back(
          {&sampler, table, {subject, strategy, {}, {}, {}}, wanted, launch_of(strategy, unit.one, wanted)});
    }
  return work;
}

// A launch of each in turn until each has its samples.
void measure(std::vector<Work>& work) {
  while (!std::ranges::all_of(work, &Work::done))
    for (Work& w : work) {
      if (w.done()) continue;
      const Sampler::Run run = w.sampler->run(w.row.subject, w.launch, w.first);
      w.first += w.sampler->samples_per_lane(w.launch);
      const auto count = static_cast<double>(run.sums.count);
      w.row.nanoseconds.push_back(1e9 * run.seconds / count);
      w.row.wall_nanoseconds.push_back(1e9 * run.wall_seconds / count);
      w.row.run.add(run);
    }
}

// ---- Going on

// What an earlier run left of a table, by the text of case and light.
using Kept = std::map<std::string, std::vector<SavedTable::Row>>;

std::string unit_text(const Unit& unit) {
  return case_text(unit.one) + "," + light_names()[static_cast<std::size_t>(unit.light)];
}

Kept kept_rows(const SavedTable& table) {
  Kept kept;
  for (const SavedTable::Row& row : table.rows()) {
    std::vector<std::string> unit;
    for (const char* column : {"kd", "ks", "n", "theta_deg", "integrand"})
      unit.push_back(table.value(row, column));
    kept[fmt::format("{}", fmt::join(unit, ","))].push_back(row);
  }
  return kept;
}

std::size_t rows_of(const Unit& unit, const std::vector<std::string>& strategies, std::size_t table) {
  return static_cast<std::size_t>(std::ranges::count_if(strategies, [&](const std::string& strategy) {
    return !left_out(strategy, unit.one) && (table == 0 || has_roulette(strategy));
  }));
}

// Removes the first units, whose rows are all there, from `units` and returns their lines for each table.
std::array<std::vector<std::string>, 2> take_finished(std::vector<Unit>& units,
                                                      const std::vector<std::string>& strategies,
                                                      const std::filesystem::path& folder) {
  const auto rows_kept = [&](std::size_t table) {
    return kept_rows(SavedTable(folder, tables[table], sampling_columns()));
  };
  std::array<Kept, 2> kept = {rows_kept(0), rows_kept(1)};
  std::array<std::vector<std::string>, 2> lines;
  std::size_t finished = 0;
  for (; finished < units.size(); ++finished) {
    const Unit& unit = units[finished];
    const std::string text = unit_text(unit);
    if (kept[0][text].size() != rows_of(unit, strategies, 0) ||
        kept[1][text].size() != rows_of(unit, strategies, 1))
      break;
    for (const std::size_t table : {0u, 1u})
      for (const SavedTable::Row& row : kept[table][text])
        lines[table].push_back(fmt::format("{}", fmt::join(row, ",")));
  }
  units.erase(units.begin(), units.begin() + static_cast<std::ptrdiff_t>(finished));
  return lines;
}

nlohmann::json settings_of(const SamplingOptions& options, const device::Device& device, int lanes,
                           const std::vector<std::string>& strategies, const std::vector<Unit>& units,
                           const std::string& kernels) {
  nlohmann::json cases = nlohmann::json::array();
  for (const Unit& unit : units) cases.push_back(unit_text(unit));
  return {{"phlux", PHLUX_VERSION},
          {"device", device.info.platform + ", " + device.info.name + ", " + device.info.driver},
          {"width", lanes},
          {"kernels", kernels},
          {"strategies", strategies},
          {"samples", samples_of(options, "exact", {})},
          {"seed", options.seed},
          {"cases", cases}};
}

// ---- Summary

struct Summary {
  double largest_bias = 0;
  int defects = 0, rows = 0, marked = 0, cheapest = 0;
  std::vector<double> relative_costs; // to lobe-ks in the same unit
};

std::map<std::string, Summary> summaries_of(const SavedTable& table) {
  const auto number = [&](const SavedTable::Row& row, const char* column) {
    return std::stod(table.value(row, column));
  };
  std::map<std::string, Summary> summaries;
  for (const auto& [unit, rows] : kept_rows(table)) {
    const auto plain =
        std::ranges::find_if(rows, [](const SavedTable::Row& row) { return row.front() == "lobe-ks"; });
    const SavedTable::Row* cheapest = nullptr;
    for (const SavedTable::Row& row : rows) {
      Summary& summary = summaries[row.front()];
      const double bias = number(row, "bias_sigma");
      const std::string& marks = table.value(row, "marks");
      if (std::abs(bias) > std::abs(summary.largest_bias) && marks.find("unresolved") == std::string::npos)
        summary.largest_bias = bias;
      summary.defects += number(row, "defects") > 0 ? 1 : 0;
      ++summary.rows;
      if (plain != rows.end())
        summary.relative_costs.push_back(number(row, "ns_per_sample") / number(*plain, "ns_per_sample"));
      if (!marks.empty()) {
        ++summary.marked;
        continue;
      }
      if (cheapest == nullptr ||
          number(row, "variance_times_cost") < number(*cheapest, "variance_times_cost"))
        cheapest = &row;
    }
    if (cheapest != nullptr) ++summaries[cheapest->front()].cheapest;
  }
  return summaries;
}

void print_summary(const std::vector<std::string>& strategies, const SavedTable& table) {
  const auto summaries = summaries_of(table);
  fmt::print("{:<22} {:>6} {:>7} {:>20} {:>8} {:>24} {:>26}\n", "strategy", "rows", "marked",
             "largest bias / sigma", "defects", "time / lobe-ks (median)", "least variance x time in");
  for (const std::string& strategy : strategies) {
    const auto found = summaries.find(strategy);
    if (found == summaries.end()) continue;
    const Summary& s = found->second;
    fmt::print("{:<22} {:>6} {:>7} {:>20.2f} {:>8} {:>24} {:>26}\n", strategy, s.rows, s.marked,
               s.largest_bias, s.defects,
               s.relative_costs.empty() ? "" : fmt::format("{:.2f}", median(s.relative_costs)), s.cheapest);
  }
}

void print_left_out(const std::vector<std::string>& strategies, const std::vector<Case>& cases) {
  if (std::ranges::count(strategies, "rejection") == 0) return;
  const auto count = std::ranges::count_if(cases, [](const Case& one) { return left_out("rejection", one); });
  if (count > 0)
    fmt::print("rejection is left out of {} cases: more than {:.0f} proposals a sample\n", count,
               most_proposals);
}

std::string command_of(const SamplingOptions& options) {
  std::string command = "phlux bench sampling";
  if (options.quick) command += " --quick";
  for (const std::string& strategy : options.strategies) command += " --strategy " + strategy;
  for (const Case& one : options.cases) command += " --case " + case_text(one);
  for (const Light light : options.lights)
    command += " --integrand " + light_names()[static_cast<std::size_t>(light)];
  if (options.samples) command += fmt::format(" --samples {}", *options.samples);
  if (options.lanes != 0) command += fmt::format(" --width {}", options.lanes);
  return command + fmt::format(" --seed {}", options.seed);
}

std::string progress_text(std::size_t done, std::size_t all, std::size_t done_now, Clock::time_point begin) {
  const std::string text = fmt::format("{} of {} measurements", done, all);
  if (done_now == 0) return text;
  const double seconds = seconds_since(begin);
  const double left = seconds / static_cast<double>(done_now) * static_cast<double>(all - done);
  return fmt::format("{}  {} left", text, clock_text(left));
}

std::vector<Sampler> build_samplers(const device::Device& device, const sources::KernelFiles& files,
                                    const std::vector<std::string>& strategies, int lanes) {
  std::vector<Sampler> samplers;
  for (const std::string& strategy : strategies) {
    samplers.emplace_back(device, files, strategy, lanes);
    (void)samplers.back().run({.4, .4, 10, 60}, 1, {{0, 0}}); // warms up
  }
  return samplers;
}

} // namespace

std::vector<Case> sampling_cases(bool quick) {
  std::vector<Case> cases = {{.4, .05, 50, 30}, {.4, .05, 50, 85}, {.4, .4, 10, 60}, {.1, .8, 90, 30}};
  const auto add_grid = [&](const std::vector<std::pair<double, double>>& materials,
                            const std::vector<double>& exponents, const std::vector<double>& angles) {
    for (const auto& [diffuse, specular] : materials)
      for (const double exponent : exponents)
        for (const double angle : angles) {
          const Case one{diffuse, specular, exponent, angle};
          if (std::ranges::count(cases, one) == 0) cases.push_back(one);
        }
  };
  if (quick)
    add_grid({{.4, .4}}, {1, 100, 1e4}, {30, 60, 85});
  else
    add_grid({{.4, .05}, {.4, .4}, {.1, .8}, {0, .9}}, {0, 1, 10, 30, 100, 300, 1e3, 1e4, 1e5, 1e6},
             {0, 15, 30, 45, 60, 75, 80, 85, 88, 89.9});
  return cases;
}

bool write_sampling_tables(const SamplingOptions& options) {
  make_folder(options.folder);
  const device::Device device = device::open_devices(options.devices).front();
  const int lanes = options.lanes_on(device.info);
  const auto strategies = strategies_of(options);
  std::vector<Unit> units = units_of(cases_of(options), lights_of(options));
  const std::size_t all = units.size();
  const sources::KernelFiles files = kernel_files(options.kernel_dir);
  const auto settings = settings_of(options, device, lanes, strategies, units,
                                    Sampler::kernels_fingerprint(files, strategies, lanes));
  std::array<std::vector<std::string>, 2> kept;
  if (goes_on(options.folder, "sampling", {tables.begin(), tables.end()}, settings, options.fresh))
    kept = take_finished(units, strategies, options.folder);
  const std::string header = fmt::format("{}", fmt::join(sampling_columns(), ","));
  std::array<CsvFile, 2> csv = {CsvFile(options.folder, tables[0], header, kept[0]),
                                CsvFile(options.folder, tables[1], header, kept[1])};
  if (units.size() < all)
    fmt::print("goes on with an earlier run: {} of {} measurements are there (--fresh makes them anew)\n",
               all - units.size(), all);
  if (units.empty()) return true;
  std::vector<Sampler> samplers = build_samplers(device, files, strategies, lanes);
  StatusLine status;
  const Clock::time_point begin = Clock::now();
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (options.interrupted && options.interrupted()) return false;
    status.show(progress_text(all - units.size() + i, all, i, begin));
    std::vector<Work> work = work_of(samplers, units[i], options);
    measure(work);
    for (const Work& w : work) csv[w.table].line(sampling_line(w.row, device.info.name, lanes));
  }
  return true;
}

bool measure_sampling(const SamplingOptions& options) {
  if (!write_sampling_tables(options)) return false;
  const device::Device device = device::open_devices(options.devices).front();
  const int lanes = options.lanes_on(device.info);
  fmt::print("{}, WIDTH {}\n", device.info.name, lanes);
  print_summary(strategies_of(options), SavedTable(options.folder, tables[0], sampling_columns()));
  print_left_out(strategies_of(options), cases_of(options));
  for (const char* table : tables) fmt::print("{}\n", (options.folder / table).string());
  std::fflush(stdout);
  write_provenance(options.folder, "sampling",
                   {command_of(options), device.info, lanes,
                    "kernels are built and run once before anything is timed", std::to_string(options.seed)});
  draw_charts(options.folder, sampling_script());
  return true;
}

} // namespace phlux::bench
