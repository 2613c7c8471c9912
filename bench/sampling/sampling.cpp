#include "bench/sampling/sampling.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/common/report/draw.h"
#include "bench/common/status_line.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/provenance.h"
#include "bench/common/tables/resume.h"
#include "bench/common/tables/saved_table.h"
#include "bench/sampling/sampling_ranking.h"
#include "bench/sampling/sampling_summary.h"
#include "bench/sampling/sampling_table.h"
#include "bench/sampling/sampling_verdict.h"
#include "clock.h"
#include "files/output.h"
#include "render/render.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

constexpr int least_rounds = 5;
constexpr std::uint64_t largest_launch = std::uint64_t{1} << 23; // samples; the kernel counts in 32 bits
// With more proposals per sample on average, `rejection` gets proportionally fewer samples by default.
constexpr double proposals_for_full_count = 16;

// Of the tables, of what resumes them, and of the section of the report.
std::string name_of(const SamplingOptions& options) {
  return options.material ? "sampling-" + options.material->model->name : "sampling";
}

// With roulette in those strategies that have_roulette(), and without it; of the Phong model, the others with
// it.
std::vector<std::string> tables_of(const SamplingOptions& options) {
  std::vector<std::string> tables = {name_of(options) + ".csv", name_of(options) + "-no-roulette.csv"};
  if (!options.material) tables.push_back(name_of(options) + "-plain-roulette.csv");
  return tables;
}

bool is_in_table(const std::string& strategy, std::size_t table) {
  return table == 0 || has_roulette(strategy) == (table == 1);
}

std::vector<SavedTable> read_tables(const SamplingOptions& options) {
  std::vector<SavedTable> tables;
  for (const std::string& name : tables_of(options))
    tables.emplace_back(options.folder, name, sampling_columns());
  return tables;
}

lobes::ModelPointer model_of(const SamplingOptions& options) {
  return options.material ? options.material->model : lobes::shipped("phong");
}

bool is_left_out(const std::string& strategy, const Case& one) {
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

// One integral, which every strategy estimates.
struct Integral {
  Case one;
  Light light = Light::constant;
  std::uint32_t number = 0; // for its seed
};

std::vector<std::string> strategies_of(const SamplingOptions& options) {
  if (options.material) return strategies_of_model(*options.material->model);
  return options.strategies.empty() ? render::strategy_names() : options.strategies;
}

std::vector<Case> cases_of(const SamplingOptions& options) {
  if (!options.material) return options.cases.empty() ? sampling_cases(options.quick) : options.cases;
  std::vector<Case> cases;
  for (const double degrees : model_angles) cases.push_back({0, 0, 0, degrees, options.material});
  return cases;
}

std::vector<Light> lights_of(const SamplingOptions& options) {
  if (options.material) return {Light::constant};
  if (!options.lights.empty()) return options.lights;
  return {Light::constant, Light::mirror_disk, Light::horizon_sky};
}

std::vector<Integral> integrals_of(const std::vector<Case>& cases, const std::vector<Light>& lights) {
  std::vector<Integral> integrals;
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (const Light light : lights)
      integrals.push_back(
          {cases[i], light,
           static_cast<std::uint32_t>(i * light_names().size() + static_cast<std::size_t>(light))});
  return integrals;
}

// A row for which samples are being taken.
struct PendingRow {
  Sampler* sampler;
  std::size_t table; // index in `tables`
  SamplingRow row;
  std::uint64_t wanted, launch; // samples in all, samples per launch
  std::uint32_t first = 0;      // number of the next sample in each lane

  [[nodiscard]] bool done() const {
    return row.run.sums.count >= wanted && row.nanoseconds.size() >= least_rounds;
  }
};

std::vector<PendingRow> pending_rows(std::vector<Sampler>& samplers, const Integral& integral,
                                     const SamplingOptions& options) {
  constexpr cl_uint most_rows = 64; // per integral; each row has its own seed
  const double reflected = options.material ? samplers.front().reflectivity_of(integral.one)
                                            : reflected_radiance(integral.one, integral.light);
  std::vector<PendingRow> pending;
  for (std::size_t table = 0; table < tables_of(options).size(); ++table)
    for (Sampler& sampler : samplers) {
      const std::string& strategy = sampler.strategy();
      if (is_left_out(strategy, integral.one) || !is_in_table(strategy, table)) continue;
      const bool absorbs = has_roulette(strategy) ? table == 0 : table == 2;
      const std::uint64_t wanted = samples_of(options, strategy, integral.one);
      const cl_uint2 seed = {
          {options.seed, integral.number * most_rows + static_cast<cl_uint>(pending.size())}};
      const Subject subject{integral.one, integral.light, absorbs, reflected, seed};
      pending.push_back({&sampler,
                         table,
                         {subject, strategy, {}, {}, {}},
                         wanted,
                         launch_of(strategy, integral.one, wanted)});
    }
  return pending;
}

// Launches the rows in turn until each has its samples.
void measure(std::vector<PendingRow>& pending) {
  while (!std::ranges::all_of(pending, &PendingRow::done))
    for (PendingRow& p : pending) {
      if (p.done()) continue;
      const Sampler::Run run = p.sampler->run(p.row.subject, p.launch, p.first);
      p.first += p.sampler->samples_per_lane(p.launch);
      const auto count = static_cast<double>(run.sums.count);
      p.row.nanoseconds.push_back(1e9 * run.seconds / count);
      p.row.wall_nanoseconds.push_back(1e9 * run.wall_seconds / count);
      p.row.run.add(run);
    }
}

// "--set NAME=VALUE" for each parameter of a given material.
std::string parameters_text(const SamplingOptions& options) {
  std::string text;
  if (!options.material) return text;
  const auto& parameters = options.material->model->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const scene::Rgb& value = options.material->values[i];
    text += fmt::format(" --set {}={:g}", parameters[i].name, value.r);
    if (parameters[i].kind == scene::Parameter::Kind::colour)
      text += fmt::format(",{:g},{:g}", value.g, value.b);
  }
  return text;
}

std::string integral_text(const Integral& integral) {
  return case_text(integral.one) + "," + light_names()[static_cast<std::size_t>(integral.light)];
}

// ---- Resuming an earlier run

std::size_t rows_of(const Integral& integral, const std::vector<std::string>& strategies, std::size_t table) {
  return static_cast<std::size_t>(std::ranges::count_if(strategies, [&](const std::string& strategy) {
    return !is_left_out(strategy, integral.one) && is_in_table(strategy, table);
  }));
}

// Removes the leading integrals whose rows are all saved, and returns these rows for each table.
std::vector<std::vector<std::string>> take_finished(std::vector<Integral>& integrals,
                                                    const std::vector<std::string>& strategies,
                                                    const SamplingOptions& options) {
  std::vector<RowsByIntegral> saved;
  for (const SavedTable& table : read_tables(options)) saved.push_back(rows_by_integral(table));
  std::vector<std::vector<std::string>> lines(saved.size());
  std::size_t finished = 0;
  for (; finished < integrals.size(); ++finished) {
    const Integral& integral = integrals[finished];
    const std::string text = integral_text(integral);
    bool complete = true;
    for (std::size_t table = 0; table < saved.size(); ++table)
      complete = complete && saved[table][text].size() == rows_of(integral, strategies, table);
    if (!complete) break;
    for (std::size_t table = 0; table < saved.size(); ++table)
      for (const SavedTable::Row& row : saved[table][text])
        lines[table].push_back(fmt::format("{}", fmt::join(row, ",")));
  }
  integrals.erase(integrals.begin(), integrals.begin() + static_cast<std::ptrdiff_t>(finished));
  return lines;
}

nlohmann::json settings_of(const SamplingOptions& options, const device::Device& device, int lanes,
                           const std::vector<std::string>& strategies, const std::vector<Integral>& integrals,
                           const std::string& kernels) {
  nlohmann::json cases = nlohmann::json::array();
  for (const Integral& integral : integrals) cases.push_back(integral_text(integral));
  return {{"phlux", PHLUX_VERSION},
          {"device", device.info.platform + ", " + device.info.name + ", " + device.info.driver},
          {"width", lanes},
          {"kernels", kernels},
          {"strategies", strategies},
          {"material", parameters_text(options)},
          {"samples", samples_of(options, "exact", {})},
          {"seed", options.seed},
          {"cases", cases}};
}

// ---- The whole measurement

void print_left_out(const std::vector<std::string>& strategies, const std::vector<Case>& cases) {
  if (std::ranges::count(strategies, "rejection") == 0) return;
  const auto count =
      std::ranges::count_if(cases, [](const Case& one) { return is_left_out("rejection", one); });
  if (count > 0)
    say("rejection is left out of {} cases: more than {:.0f} proposals per sample\n", count, most_proposals);
}

std::string command_of(const SamplingOptions& options) {
  std::string command = "phlux bench sampling";
  if (options.quick) command += " --quick";
  if (options.material) {
    const scene::Model& model = *options.material->model;
    command +=
        (model.text.empty() ? " --model " + model.name : " --lobe " + model.file) + parameters_text(options);
  }
  for (const std::string& strategy : options.strategies) command += " --strategy " + strategy;
  for (const Case& one : options.cases) command += " --case " + case_text(one);
  for (const Light light : options.lights)
    command += " --integrand " + light_names()[static_cast<std::size_t>(light)];
  if (options.samples) command += fmt::format(" --samples {}", *options.samples);
  if (options.ray_ns) command += fmt::format(" --ray-cost {}", *options.ray_ns);
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
                                    const SamplingOptions& options, int lanes) {
  std::vector<Sampler> samplers;
  for (const std::string& strategy : strategies_of(options)) {
    samplers.emplace_back(device, files, strategy, lanes, model_of(options));
    const Subject any{{.4, .4, 10, 60, options.material}};
    (void)samplers.back().run(any, 1); // the first launch may compile
  }
  return samplers;
}

// A sentence on each case that was asked for, with an empty line between, or one on the grid.
std::string verdict_of(const SamplingOptions& options, const std::vector<Ranking>& rankings,
                       const VerdictConditions& conditions) {
  if (options.cases.empty()) return verdict_on_grid(rankings, conditions);
  return fmt::format("{}", fmt::join(verdicts_on_cases(rankings, conditions), "\n\n"));
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
  const auto tables = tables_of(options);
  std::vector<Integral> integrals = integrals_of(cases_of(options), lights_of(options));
  const std::size_t all = integrals.size();
  const sources::KernelFiles files(options.kernel_dir);
  const auto settings =
      settings_of(options, device, lanes, strategies, integrals,
                  Sampler::kernels_fingerprint(files, strategies, lanes, model_of(options)));
  std::vector<std::vector<std::string>> saved(tables.size());
  if (can_resume(options.folder, name_of(options), tables, settings, options.fresh))
    saved = take_finished(integrals, strategies, options);
  const std::string header = fmt::format("{}", fmt::join(sampling_columns(), ","));
  std::vector<CsvFile> csv;
  for (std::size_t table = 0; table < tables.size(); ++table)
    csv.emplace_back(options.folder, tables[table], header, saved[table]);
  if (integrals.size() < all)
    say("resumes an earlier run: {} of {} measurements are there\n", all - integrals.size(), all);
  if (integrals.empty()) return true;
  std::vector<Sampler> samplers = build_samplers(device, files, options, lanes);
  StatusLine status;
  const Clock::time_point begin = Clock::now();
  for (std::size_t i = 0; i < integrals.size(); ++i) {
    if (options.interrupted && options.interrupted()) return false;
    status.show(progress_text(all - integrals.size() + i, all, i, begin));
    std::vector<PendingRow> pending = pending_rows(samplers, integrals[i], options);
    measure(pending);
    for (const PendingRow& p : pending) csv[p.table].line(sampling_line(p.row, device.info.name, lanes));
  }
  return true;
}

bool measure_sampling(const SamplingOptions& options) {
  if (!write_sampling_tables(options)) return false;
  const device::Device device = device::open_devices(options.devices).front();
  const int lanes = options.lanes_on(device.info);
  const std::vector<SavedTable> tables = read_tables(options);
  const double ray_ns = options.ray_ns.value_or(default_ray_cost(tables.front()));
  const std::vector<Ranking> rankings = rankings_of(tables, ray_ns);
  const std::string name = fmt::format("{}, WIDTH {}", device.info.name, lanes);
  say("{}\n", name);
  print_sampling_summary(strategies_of(options), tables.front(), rankings);
  print_left_out(strategies_of(options), cases_of(options));
  for (const SavedTable& table : tables) say("{}\n", table.path().string());
  write_rankings(options.folder, name_of(options) + ".ranking.csv", rankings, ray_ns);
  const std::string verdict = verdict_of(
      options, rankings, {ray_ns, name, options.material ? "" : "--strategy ", clock_of(device.info)});
  files::write_file(options.folder / (name_of(options) + ".verdict.txt"), verdict + "\n");
  say("\n{}\n", verdict);
  write_provenance(options.folder, name_of(options),
                   {command_of(options), device.info, lanes,
                    "kernels are built and run once before anything is timed", std::to_string(options.seed)});
  draw_charts(options.folder, options.material ? "sampling_model" : "sampling");
  return true;
}

} // namespace phlux::bench
