#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/outputs.h"
#include "cli/spelling.h"
#include "cli/verify_tables.h"
#include "clock.h"
#include "device/device.h"
#include "files/json.h"
#include "files/output.h"
#include "terminal.h"
#include "verify/integrators/check_integrators.h"
#include "verify/lobe/contradictions.h"
#include "verify/lobe/verify_lobe.h"
#include "verify/meanings.h"
#include "verify/verify.h"

namespace phlux::cli {
namespace {

using verify::Report;
using verify::Result;
using verify::Sense;

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
    json["results"].push_back({{verify::kind_of(r) == verify::Kind::integrator ? "integrator" : "strategy",
                                r.strategy.empty() ? "model" : r.strategy},
                               {"check", r.check},
                               {"figure", r.sense == Sense::probability ? "p_value" : "worst"},
                               {"worst", r.worst},
                               {"limit", r.limit},
                               {"passed", r.passed},
                               {"figures", r.seen},
                               {"where", r.where},
                               {"meaning", verify::meaning_of(r)},
                               {"look_at", r.passed ? "" : verify::function_to_look_at(r)},
                               {"note", with_options(r.note)},
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

// Verifies; adds what follows from several failures together.
Report run(const device::Device& device, const verify::Settings& settings, const VerifyOptions& options,
           const std::vector<verify::LobeToVerify>& lobes, std::vector<std::string>& conclusions) {
  if (lobes.empty()) {
    Report report = verify::run(device, settings);
    for (const std::string& text : verify::integrators_not_to_use(report))
      conclusions.push_back(with_options(text));
    return report;
  }
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
  if (!options.json.empty()) {
    reject_inputs({options.json}, options.lobes);
    reject_inputs({options.json}, {options.strategies.begin(), options.strategies.end()});
    files::check_writable(options.json);
  }
  verify::Settings settings;
  settings.lanes = options.lanes != 0 ? options.lanes : device.info.lanes;
  settings.quick = options.quick;
  settings.samples = options.samples;
  settings.strategies = options.strategies;
  settings.integrators = options.integrators;
  if (!options.kernel_dir.empty()) settings.kernels = sources::KernelFiles(options.kernel_dir);
  say("{} ({}, driver {}), WIDTH {}\n", device.info.name, device.info.platform, device.info.driver,
      settings.lanes);
  const Clock::time_point start = Clock::now();
  std::vector<std::string> conclusions;
  Report report = run(device, settings, options, lobes, conclusions);
  const double seconds = seconds_since(start);
  verify::write_failures(report);
  print_results(report);
  print_meanings(report);
  print_failures(report);
  for (const std::string& text : conclusions) say("{}\n", text);
  if (!options.json.empty()) {
    auto json = json_of(report, device, settings.lanes, seconds);
    json["conclusions"] = conclusions;
    files::write_file(options.json, files::json_text(json));
  }
  if (device::portable_lanes(device))
    say("portable lanes: the compiler refuses the intrinsics of the processor\n");
  say("{}: {} checks, {} p-values with a false alarm in {:g} runs, {:.1f} s\n",
      report.passed() ? "passed" : "FAILED", report.results().size(), report.p_values(),
      1 / verify::false_alarm_rate, seconds);
  return report.passed() ? 0 : 1;
}

} // namespace phlux::cli
