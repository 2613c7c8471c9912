#include "verify/verify.h"

#include <algorithm>

#include "verify/checks.h"
#include "verify/integrators/check_integrators.h"

namespace phlux::verify {

std::size_t samples_of(const device::Device& device, const Settings& settings) {
  if (settings.samples > 0) return settings.samples;
  // Oclgrind, an interpreter, is about a thousand times slower.
  if (device.info.platform == "Oclgrind") return 64;
  return settings.quick ? 8192 : 16384;
}

namespace {

void check_strategies(const device::Device& device, const Settings& settings, Report& report) {
  const Cases cases = make_cases(settings.quick);
  std::vector<CaseCells> cells;
  for (const Case& one : cases.cases) cells.push_back(cells_of(one.at));
  const std::vector<scene::Material> known_materials = variance_materials();
  bool first = true;
  for (const Strategy& strategy : strategies()) {
    if (!settings.strategies.empty() &&
        std::ranges::find(settings.strategies, strategy.name) == settings.strategies.end())
      continue;
    const DeviceModel model(device, settings.kernels, settings.lanes, strategy.name, cases.materials);
    const Subject subject{strategy,       model, cases, cells, samples_of(device, settings),
                          settings.quick, report};
    check_samples(subject);
    check_partial(subject);
    check_pairs(subject);
    check_jacobian(subject);
    check_extremes(subject);
    const DeviceModel known(device, settings.kernels, settings.lanes, strategy.name, known_materials);
    check_variances(subject, known, known_materials);
    if (!first) continue;
    first = false;
    const ModelCases model_cases = make_model_cases(settings.quick);
    const DeviceModel of_model(device, settings.kernels, settings.lanes, strategy.name,
                               model_cases.materials);
    check_model(of_model, model_cases, settings.quick, subject.samples / 2, report);
  }
}

} // namespace

Report run(const device::Device& device, const Settings& settings) {
  Report report;
  const bool all = settings.strategies.empty() && settings.integrators.empty();
  if (all || !settings.strategies.empty()) check_strategies(device, settings, report);
  if (all || !settings.integrators.empty()) check_integrators(device, settings, report);
  report.judge();
  return report;
}

} // namespace phlux::verify
