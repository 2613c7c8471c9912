#include <glm/geometric.hpp>

#include "measure/moments.h"
#include "measure/statistics.h"
#include "verify/extremes.h"
#include "verify/lobe/checks.h"

namespace phlux::verify {
namespace {

constexpr double unit_error = 16 * 0x1p-23; // of a float32 direction's length
constexpr double weight_floor = 1e-4;

bool is_valid(const Sample& s) {
  return is_finite(s.direction) && is_finite(s.weight) &&
         std::min({s.weight.r, s.weight.g, s.weight.b}) >= 0 && std::isfinite(s.density) && s.density >= 0 &&
         s.draws >= 1;
}

double weight_disagreement(const Sample& s, const PairValues& at) {
  double worst = 0;
  for (int channel = 0; channel < 3; ++channel) {
    const double right = at.density > 0 ? at.value[channel] * std::abs(s.direction.z) / at.density : 0;
    worst = std::max(worst, disagreement(s.weight[channel], right, weight_floor));
  }
  return worst;
}

// Compares densities and weights of samples with evaluate.
void check_against_evaluate(const LobeSubject& subject, const LobeCase& one,
                            const std::vector<Sample>& samples) {
  std::vector<Pair> pairs;
  std::vector<const Sample*> smooth;
  for (const Sample& s : samples)
    if (!s.delta && subject.counts(s)) {
      pairs.push_back({one.fixed, s.direction});
      smooth.push_back(&s);
    }
  if (pairs.empty()) return;
  const auto values = subject.device.evaluate(one.material, pairs);
  double density = 0, weight = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    density = std::max(density, disagreement(smooth[i]->density, values[i].density, density_floor));
    weight = std::max(weight, weight_disagreement(*smooth[i], values[i]));
  }
  subject.record("stated density", density, agreement, one.where);
  if (!subject.weighs_by_part) subject.record("weights", weight, agreement, one.where);
}

// Chi-square of directions against the density. Delta events and samples below the surface have a cell of
// their own, with the probability that the density leaves.
void check_directions(const LobeSubject& subject, const LobeCase& one, const DirectionTree& tree,
                      const std::vector<Sample>& samples) {
  const auto count = static_cast<double>(samples.size());
  DirectionTree::Cells cells = tree.cells(count);
  const std::size_t aside = cells.expected.size();
  std::vector<double> observed(aside + 1);
  for (const Sample& s : samples)
    observed[!s.delta && subject.counts(s) ? cells.of_leaf[tree.leaf_of(s.direction)] : aside] += 1;
  // A wrong integral of the density is the failure of another check; here the density is scaled to its
  // samples.
  const double integral = tree.total().density, share = 1 - observed[aside] / count;
  const double scale = integral > 0 && std::abs(integral - share) > 0.02 ? share / integral : 1;
  for (double& cell : cells.expected) cell *= scale;
  cells.expected.push_back(std::max(0.0, count * (1 - scale * integral)));
  const double p = chi_square_p(observed, cells.expected);
  if (!subject.report.record_p(subject.name, "directions", p, one.where)) return;
  Histogram histogram{{"cell", "observed", "expected"}, {}, 0, {}};
  for (std::size_t i = 0; i <= aside; ++i)
    histogram.rows.push_back({static_cast<double>(i), observed[i], cells.expected[i]});
  subject.report.keep(subject.name, "directions", std::move(histogram));
}

bool enough_carry(const std::vector<Sample>& samples) {
  constexpr double fewest = 400;
  double sum = 0, squares = 0;
  for (const Sample& s : samples) {
    const double weight = s.weight.r + s.weight.g + s.weight.b;
    sum += weight;
    squares += weight * weight;
  }
  return squares == 0 || sum * sum / squares >= fewest;
}

SampleMeans means_of(const LobeSubject& subject, const std::vector<Sample>& samples) {
  SampleMeans means;
  const auto mean = [&](const auto& quantity, double& value, double& error) {
    PowerSums sums;
    for (const Sample& s : samples) sums.add(quantity(s));
    const Moments moments = moments_of(sums);
    value = moments.mean;
    error = moments.mean_standard_error;
  };
  mean([&](const Sample& s) { return s.delta || !subject.counts(s) ? 1 : 0; }, means.aside,
       means.aside_error);
  for (int channel = 0; channel < 3; ++channel) {
    const auto weight = [=](const Sample& s) { return s.weight[channel]; };
    mean([=](const Sample& s) { return s.delta ? 0 : weight(s); }, means.reflected[channel],
         means.reflected_error[channel]);
    mean([=](const Sample& s) { return s.delta ? weight(s) : 0; }, means.delta[channel],
         means.delta_error[channel]);
    mean(weight, means.all[channel], means.all_error[channel]);
  }
  means.trusted = enough_carry(samples);
  return means;
}

// Records invalid samples and replaces them by black ones below the surface.
void check_each(const LobeSubject& subject, const std::string& where, std::vector<Sample>& samples) {
  double wrong = 0, length = 0, undeclared = 0;
  for (Sample& s : samples) {
    if (!s.survives) continue;
    if (!is_valid(s)) {
      ++wrong;
      s = Sample{{1, 0, 0}, Rgb(0)};
    }
    if (subject.counts(s)) length = std::max(length, std::abs(glm::length(s.direction) - 1));
    if (s.delta && !subject.model.has_delta) ++undeclared;
  }
  subject.record("sample finite", wrong, 0, where);
  subject.record("unit", length, unit_error, where);
  subject.record("delta declared", undeclared, 0, where);
}

// The mean weight must be the same with roulette.
void check_roulette(const LobeSubject& subject, const LobeCase& one, const SampleMeans& without) {
  auto samples = subject.device.sample(one.material, one.fixed, subject.samples, one.seed + 2, true);
  check_each(subject, one.where + ", roulette", samples);
  for (Sample& s : samples)
    if (!s.survives) s = Sample{{1, 0, 0}, Rgb(0)};
  const SampleMeans with = means_of(subject, samples);
  if (!with.trusted || !without.trusted) return;
  for (int channel = 0; channel < 3; ++channel) {
    const double off = std::abs(with.all[channel] - without.all[channel]);
    const double beyond = std::max(0.0, off - 1e-4);
    const double error = std::hypot(with.all_error[channel], without.all_error[channel]);
    subject.report.record_p(subject.name, "roulette", normal_p(beyond == 0 ? 0 : beyond / error), one.where);
  }
}

} // namespace

SampleMeans check_lobe_samples(const LobeSubject& subject, const LobeCase& one, const DirectionTree& tree) {
  auto samples = subject.device.sample(one.material, one.fixed, subject.samples, one.seed, false);
  check_each(subject, one.where, samples);
  check_against_evaluate(subject, one, samples);
  check_directions(subject, one, tree, samples);
  const SampleMeans means = means_of(subject, samples);
  check_roulette(subject, one, means);
  return means;
}

void check_lobe_extremes(const LobeSubject& subject, int material, const std::string& where) {
  const std::vector<Words> words = extreme_words(false);
  const std::vector<Direction> directions = extreme_directions();
  std::vector<Direction> above;
  for (const Direction& fixed : directions)
    if (fixed.z > 0) { // as the interface requires
      above.push_back(fixed);
      if (subject.model.transmits) above.push_back(fixed * Direction(1, 1, -1));
    }
  for (const Direction& fixed : above)
    for (const bool roulette : {false, true}) {
      auto samples = subject.device.drive(material, fixed, words, roulette);
      check_each(subject, where + ", extreme random numbers", samples);
    }
  double wrong = 0;
  for (const Rgb& r : subject.device.reflectivity(material, above))
    if (!is_finite(r) || std::min({r.r, r.g, r.b}) < 0) ++wrong;
  subject.record("reflectivity finite", wrong, 0, where + ", grazing and normal incidence");
}

} // namespace phlux::verify
