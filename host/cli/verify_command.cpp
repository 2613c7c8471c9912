#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/table.h"
#include "clock.h"
#include "device/device.h"
#include "files/json.h"
#include "files/output.h"
#include "verify/lobe/contradictions.h"
#include "verify/lobe/verify_lobe.h"
#include "verify/verify.h"

namespace phlux::cli {
namespace {

using verify::Report;
using verify::Result;
using verify::Sense;

std::string figure(const Result& result) {
  if (!result.passed) return fmt::format("FAIL {:.1e}", result.worst);
  return fmt::format("{}{:.2g}", result.sense == Sense::probability ? "p " : "", result.worst);
}

// In the order of their first appearance.
std::vector<std::string> distinct(const Report& report, bool of_strategies, std::string Result::*member) {
  std::vector<std::string> names;
  for (const Result& result : report.results())
    if (result.strategy.empty() != of_strategies && std::ranges::find(names, result.*member) == names.end())
      names.push_back(result.*member);
  return names;
}

std::string limit_text(const Result& result) {
  return fmt::format("{} {:.3g}", result.sense == Sense::probability ? "p >" : "<=", result.limit);
}

// One column per check, the strategies below each other; what is not checked for a strategy is "-".
std::vector<std::string> column_of(const Report& report, const std::string& check,
                                   const std::vector<std::string>& strategies) {
  std::vector<std::string> column{check, ""};
  for (const std::string& strategy : strategies) {
    const auto found = std::ranges::find_if(
        report.results(), [&](const Result& r) { return r.strategy == strategy && r.check == check; });
    const bool none = found == report.results().end();
    column.push_back(none ? "-" : figure(*found));
    if (!none) column[1] = limit_text(*found);
  }
  return column;
}

// In blocks of columns as wide as a terminal.
void print_strategies(const Report& report) {
  constexpr std::size_t columns_per_block = 7;
  const auto strategies = distinct(report, true, &Result::strategy),
             checks = distinct(report, true, &Result::check);
  for (std::size_t first = 0; first < checks.size(); first += columns_per_block) {
    std::vector<std::vector<std::string>> rows{{"STRATEGY"}, {"  limit"}};
    for (const std::string& strategy : strategies) rows.push_back({strategy});
    for (std::size_t i = first; i < std::min(checks.size(), first + columns_per_block); ++i) {
      const auto column = column_of(report, checks[i], strategies);
      for (std::size_t row = 0; row < rows.size(); ++row) rows[row].push_back(column[row]);
    }
    print_table(rows);
    fmt::print("\n");
  }
}

// One row per check of the strategy or model of this name; empty: of the Phong model.
void print_model(const Report& report, const std::string& name) {
  std::vector<std::vector<std::string>> rows{{name.empty() ? "MODEL" : name, "worst", "limit", "where"}};
  for (const Result& result : report.results())
    if (result.strategy == name)
      rows.push_back({result.check, figure(result), limit_text(result), result.where});
  if (rows.size() > 1) print_table(rows);
}

void print_notes(const Report& report) {
  for (const Result& result : report.results())
    if (result.passed && !result.note.empty())
      fmt::print("{}{}: {}\n", result.strategy.empty() ? "" : result.strategy + ": ", result.check,
                 result.note);
  for (const Result& result : report.results()) {
    if (result.passed) continue;
    fmt::print("FAILED {} {}: {}{:.6g}, must be {}, for {}\n",
               result.strategy.empty() ? "model" : result.strategy, result.check,
               result.note.empty() ? "" : result.note + ": ", result.worst, limit_text(result), result.where);
    for (const std::string& file : result.files) fmt::print("  written: {}\n", file);
  }
}

nlohmann::ordered_json json_of(const Report& report, const device::Device& device, int lanes,
                               double seconds) {
  const device::DeviceInfo& info = device.info;
  nlohmann::ordered_json json = {{"device", info.name},
                                 {"platform", info.platform},
                                 {"driver", info.driver},
                                 {"width", lanes},
                                 {"portable_lanes", device::portable_lanes(device)},
                                 {"seconds", seconds},
                                 {"false_alarm_rate", verify::false_alarm_rate},
                                 {"p_values", report.p_values()},
                                 {"passed", report.passed()},
                                 {"results", nlohmann::ordered_json::array()}};
  for (const Result& r : report.results())
    json["results"].push_back({{"strategy", r.strategy.empty() ? "model" : r.strategy},
                               {"check", r.check},
                               {"figure", r.sense == Sense::probability ? "p_value" : "worst"},
                               {"worst", r.worst},
                               {"limit", r.limit},
                               {"passed", r.passed},
                               {"figures", r.seen},
                               {"where", r.where},
                               {"note", r.note},
                               {"files", r.files}});
  return json;
}

// The models to verify without closed forms: all that were named, if any of them is not the Phong model with
// built-in strategies.
std::vector<verify::LobeToVerify> lobes_of(const VerifyOptions& options) {
  const lobes::Library library(options.lobes);
  std::vector<verify::LobeToVerify> list;
  for (const auto& file : options.lobes)
    list.push_back({library.find(file.stem().string()), "exact", file.stem()});
  for (const std::string& name : options.models) list.push_back({lobes::shipped(name), "exact", name});
  if (list.empty() && std::ranges::none_of(options.strategies, settings::is_strategy_file)) return list;
  for (const std::string& strategy : options.strategies) {
    if (settings::is_strategy_file(strategy)) static_cast<void>(settings::read_strategy(strategy));
    list.push_back({lobes::shipped("phong"), strategy, "phong by " + strategy});
  }
  return list;
}

Report run_lobes(const device::Device& device, const verify::Settings& settings, const VerifyOptions& options,
                 const std::vector<verify::LobeToVerify>& lobes, std::vector<std::string>& conclusions) {
  Report report;
  for (const verify::LobeToVerify& lobe : lobes)
    verify::check_lobe(device, settings, lobe, options.parameters, report);
  report.judge();
  for (const verify::LobeToVerify& lobe : lobes)
    for (const std::string& text : verify::explain(report, lobe.name, lobe.model->name))
      conclusions.push_back(text);
  return report;
}

} // namespace

int verify(const VerifyOptions& options) {
  const std::vector<verify::LobeToVerify> lobes = lobes_of(options);
  const device::Device device = device::open_devices(options.devices).front();
  if (!options.json.empty()) files::check_writable(options.json);
  verify::Settings settings;
  settings.lanes = options.lanes != 0 ? options.lanes : device.info.lanes;
  settings.quick = options.quick;
  settings.samples = options.samples;
  settings.strategies = options.strategies;
  if (!options.kernel_dir.empty()) settings.kernels = sources::KernelFiles(options.kernel_dir);
  fmt::print("{} ({}, driver {}), WIDTH {}\n", device.info.name, device.info.platform, device.info.driver,
             settings.lanes);
  const Clock::time_point start = Clock::now();
  std::vector<std::string> conclusions;
  Report report = lobes.empty() ? verify::run(device, settings)
                                : run_lobes(device, settings, options, lobes, conclusions);
  const double seconds = seconds_since(start);
  verify::write_failures(report);
  if (lobes.empty()) {
    print_strategies(report);
    print_model(report, "");
  }
  for (const verify::LobeToVerify& lobe : lobes) print_model(report, lobe.name);
  fmt::print("\n");
  print_notes(report);
  for (const std::string& text : conclusions) fmt::print("{}\n", text);
  if (!options.json.empty()) {
    auto json = json_of(report, device, settings.lanes, seconds);
    if (!lobes.empty()) json["conclusions"] = conclusions;
    files::write_file(options.json, files::json_text(json));
  }
  if (device::portable_lanes(device))
    fmt::print("portable lanes: the compiler refuses the processor's own instructions\n");
  fmt::print("{}: {} checks, {} p-values with a false alarm in {:g} runs, {:.1f} s\n",
             report.passed() ? "passed" : "FAILED", report.results().size(), report.p_values(),
             1 / verify::false_alarm_rate, seconds);
  return report.passed() ? 0 : 1;
}

} // namespace phlux::cli
