#include "verify/lobe/verify_lobe.h"

#include <fmt/format.h>

#include "verify/lobe/checks.h"

namespace phlux::verify {
namespace {

void check_case(const LobeSubject& subject, const LobeCase& one) {
  const DirectionTree tree = integrate_lobe(subject, one);
  const SampleMeans means = check_lobe_samples(subject, one, tree);
  check_integrals(subject, one, tree, means);
  check_map(subject, one);
}

} // namespace

void check_lobe(const device::Device& device, const Settings& settings, const LobeToVerify& lobe,
                const Assignments& assignments, Report& report) {
  const std::vector<NamedMaterial> named = materials_of(lobe.model, assignments);
  std::vector<scene::Material> materials;
  for (const NamedMaterial& each : named) materials.push_back(each.material);
  const DeviceModel kernels(device, settings.kernels, settings.lanes, lobe.strategy, materials);
  const LobeSubject subject{
      *lobe.model, lobe.name, kernels, samples_of(device, settings), lobe.strategy != "exact", report};
  std::uint32_t seed = 1;
  for (std::size_t m = 0; m < named.size(); ++m) {
    const auto material = static_cast<int>(m);
    for (const FixedDirection& fixed : fixed_directions(settings.quick, lobe.model->transmits)) {
      check_case(subject, {material, fixed.direction,
                           fmt::format("{}, fixed at {}", named[m].name, fixed.name), seed});
      seed += 3; // for samples, pilot samples, and samples with roulette
    }
    const LobeCase whole{material, {}, named[m].name};
    check_below(subject, whole);
    check_isotropy(subject, whole);
    check_lobe_extremes(subject, material, named[m].name);
  }
}

} // namespace phlux::verify
