#include <cmath>

#include <fmt/format.h>

#include "measure/moments.h"
#include "scene/scene.h"
#include "verify/checks.h"

namespace phlux::verify {
namespace {

constexpr double most_sigmas = 4;
constexpr std::size_t batch = 1 << 18; // samples at once

// Variances of one sample of the reflectivity, by quadrature; with roulette for strategies that
// choose between lobes.
struct KnownVariance {
  double diffuse, specular, exponent, degrees;
  double uniform, cosine, lobe_ks, lobe_rho, mixture;

  [[nodiscard]] double of(const std::string& strategy) const { // 0: not known
    if (strategy == "uniform") return uniform;
    if (strategy == "cosine" || strategy == "disk") return cosine;
    if (strategy == "lobe-ks") return lobe_ks;
    if (strategy == "lobe-rho") return lobe_rho;
    if (strategy == "mixture") return mixture;
    return 0;
  }
};
constexpr KnownVariance known_variances[] = {
    {.4, .05, 50, 30, 0.125456, 0.026823, 0.241243, 0.247084, 0.246900},
    {.4, .05, 50, 85, 0.051849, 0.003204, 0.236758, 0.246387, 0.243692},
    {.4, .4, 10, 60, 0.324622, 0.221324, 0.165507, 0.290892, 0.275923},
    {.1, .8, 90, 30, 21.864599, 12.407981, 0.073705, 0.166876, 0.166749}};

// Shares of the specular part that CW 197's printed estimate loses.
struct KnownLoss {
  double exponent, degrees, share, digits; // `digits`: half of the last printed one
};
constexpr KnownLoss known_losses[] = {
    {50, 85, .27, .005}, {50, 80, .107, .0005}, {50, 75, .031, .0005}, {10, 80, .285, .0005}};

Moments draw(const DeviceModel& device, const Case& one, std::size_t count, std::uint32_t seed,
             bool roulette) {
  PowerSums sums;
  for (std::size_t first = 0; first < count; first += batch)
    for (const Sample& s : device.sample(one.material, one.at.fixed, std::min(batch, count - first), seed,
                                         roulette, static_cast<std::uint32_t>(first)))
      sums.add(s.survives ? s.weight.r : 0.0);
  return moments_of(sums);
}

void check_known_variances(const Subject& subject, const DeviceModel& device,
                           const std::vector<scene::Material>& materials, std::size_t count) {
  const Strategy& strategy = subject.strategy;
  const bool roulette = strategy.family != Family::smooth;
  for (std::size_t i = 0; i < std::size(known_variances); ++i) {
    const Case one = make_case(materials, static_cast<int>(i), known_variances[i].degrees);
    const Moments m = draw(device, one, count, 900 + static_cast<std::uint32_t>(i), roulette);
    const double mean = one.at.total().r, allowed = 1e-5 * mean; // float32
    if (!strategy.biased())
      subject.report.record(strategy.name, "mean, long",
                            std::max(0.0, std::abs(m.mean - mean) - allowed) / m.mean_standard_error,
                            most_sigmas, one.name);
    // With weight 1 the only variance is that of roulette.
    const double known = strategy.name == "exact" || strategy.name == "rejection"
                             ? mean * (1 - mean)
                             : known_variances[i].of(strategy.name);
    if (known > 0)
      subject.report.record(strategy.name, "variance",
                            std::max(0.0, std::abs(m.variance - known) - 1e-6) / m.variance_standard_error,
                            most_sigmas, one.name);
  }
}

void check_known_losses(const Subject& subject, const DeviceModel& device,
                        const std::vector<scene::Material>& materials, std::size_t count) {
  const std::string check = "loss as derived";
  std::string note = "biased, as printed in CW 197: loses";
  for (std::size_t i = 0; i < std::size(known_losses); ++i) {
    const Case one =
        make_case(materials, static_cast<int>(std::size(known_variances) + i), known_losses[i].degrees);
    const Moments m = draw(device, one, count, 950 + static_cast<std::uint32_t>(i), true);
    const double specular = one.at.reflectivity, loss = 1 - m.mean / specular,
                 error = m.mean_standard_error / specular;
    const double derived = cells_of(one.at).below; // the probability that the estimate is 0
    subject.report.record(subject.strategy.name, check, std::abs(loss - derived) / error, most_sigmas,
                          one.name);
    subject.report.record(subject.strategy.name, "loss as known",
                          std::abs(derived - known_losses[i].share) / known_losses[i].digits, 1, one.name);
    note += fmt::format(
        "{} {:.2f} +- {:.2f}% of the specular part at n {:g}, {:g} degrees ({:.1f}% by quadrature)",
        i == 0 ? "" : ",", 100 * loss, 100 * error, known_losses[i].exponent, known_losses[i].degrees,
        100 * derived);
  }
  subject.report.note(subject.strategy.name, check, note);
}

} // namespace

std::vector<scene::Material> variance_materials() {
  std::vector<scene::Material> materials;
  const auto add = [&](double diffuse, double specular, double exponent) {
    materials.push_back(lobes::phong(Rgb(diffuse), Rgb(specular), exponent));
  };
  for (const auto& known : known_variances) add(known.diffuse, known.specular, known.exponent);
  for (const auto& known : known_losses) add(0, 1, known.exponent);
  return materials;
}

void check_variances(const Subject& subject, const DeviceModel& device,
                     const std::vector<scene::Material>& materials) {
  const std::size_t count = subject.samples * (subject.quick ? 8 : 64);
  check_known_variances(subject, device, materials, count);
  if (subject.strategy.biased()) check_known_losses(subject, device, materials, 4 * count);
}

} // namespace phlux::verify
