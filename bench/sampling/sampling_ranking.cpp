#include "bench/sampling/sampling_ranking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "bench/common/tables/csv.h"
#include "bench/sampling/sampling_table.h"
#include "measure/moments.h"
#include "measure/statistics.h"
#include "settings/strategies.h"

namespace phlux::bench {
namespace {

constexpr double false_alarm_rate = 0.05; // of all intervals of a ranking together
constexpr double samples_per_ray = 20;

// A variance below that of float32 rounding counts as that.
double product(const Competitor& c) {
  return std::max(c.variance, float_rounding * float_rounding) * c.cost;
}

// Standard error of log(variance x cost).
double log_error(const Competitor& c) {
  return std::hypot(c.constant() ? 0 : c.variance_standard_error / c.variance,
                    c.cost_standard_error / c.cost);
}

// Standard error of the median of `count` times. Other programs only lengthen some of them, so that the
// median and the least tell the standard deviation: for normally distributed values the expected difference
// is q deviations, with the quantile q of (count - 3/8) / (count + 1/4) (Blom 1958). Requires two values or
// more.
double median_error(double median, double least, double count) {
  const double deviation = (median - least) / measure::normal_sigmas(1.25 / (count + 0.25));
  return deviation * std::sqrt(std::numbers::pi / 2 / count);
}

double number(const SavedTable& table, const SavedTable::Row& row, const char* column) {
  return std::stod(table.value(row, column));
}

bool is_biased(const std::string& strategy) {
  return std::ranges::any_of(settings::strategies,
                             [&](const settings::Strategy& s) { return s.name == strategy && s.biased; });
}

Competitor competitor_of(const SavedTable& table, const SavedTable::Row& row, double ray_ns) {
  const auto value = [&](const char* column) { return number(table, row, column); };
  const double square = value("exact") * value("exact"), rays = value("rays_per_sample");
  Competitor c;
  c.strategy = row.front();
  c.marks = table.value(row, "marks");
  if (c.marks.empty() && is_biased(c.strategy))
    c.marks = "biased"; // by too little to be measured in this case
  c.variance = value("variance") / square;
  c.variance_standard_error = value("variance_standard_error") / square;
  c.cost = value("ns_per_sample") + ray_ns * rays;
  const double rays_error = std::sqrt(std::max(0.0, rays * (1 - rays)) / value("samples"));
  c.cost_standard_error = std::hypot(median_error(value("ns_per_sample"), value("ns_least"), value("rounds")),
                                     ray_ns * rays_error);
  return c;
}

// The ranking of the integral of this row, which is appended if it is not there.
using Places = std::map<std::string, std::size_t>;
Ranking& ranking_of(std::vector<Ranking>& rankings, Places& places, const Ranking& wanted) {
  const auto [place, added] = places.try_emplace(wanted.one + wanted.light, rankings.size());
  return added ? rankings.emplace_back(wanted) : rankings[place->second];
}

} // namespace

bool Competitor::constant() const {
  return variance <= float_rounding * float_rounding;
}

std::vector<Competitor> ranked(std::vector<Competitor> competitors) {
  const auto others = std::ranges::stable_partition(competitors, &Competitor::compared);
  std::sort(competitors.begin(), others.begin(),
            [](const Competitor& a, const Competitor& b) { return product(a) < product(b); });
  const auto compared = static_cast<std::size_t>(others.begin() - competitors.begin());
  if (compared < 2) return competitors;
  const Competitor& best = competitors.front();
  const double sigmas = measure::normal_sigmas(measure::sidak_limit(false_alarm_rate, compared - 1));
  for (std::size_t i = 1; i < compared; ++i) {
    Competitor& c = competitors[i];
    if (best.constant() && !c.constant()) {
      c.factor = c.least = c.most = std::numeric_limits<double>::infinity();
      continue;
    }
    const double spread = std::exp(sigmas * std::hypot(log_error(best), log_error(c)));
    c.factor = product(c) / product(best);
    c.least = c.factor / spread;
    c.most = c.factor * spread;
  }
  return competitors;
}

std::vector<Competitor> Ranking::winners() const {
  std::vector<Competitor> winners;
  std::ranges::copy_if(competitors, std::back_inserter(winners), &Competitor::wins);
  return winners;
}

double default_ray_cost(const SavedTable& table) {
  std::vector<double> times, of_lobe_ks;
  for (const SavedTable::Row& row : table.rows()) {
    times.push_back(number(table, row, "ns_per_sample"));
    if (row.front() == "lobe-ks") of_lobe_ks.push_back(times.back());
  }
  return samples_per_ray * measure::median(of_lobe_ks.empty() ? times : of_lobe_ks);
}

std::vector<Ranking> rankings_of(const std::vector<SavedTable>& tables, double ray_ns) {
  std::vector<Ranking> rankings;
  for (const bool roulette : {false, true}) {
    Places places;
    for (const SavedTable& table : tables)
      for (const SavedTable::Row& row : table.rows())
        if ((table.value(row, "roulette") == "1") == roulette)
          ranking_of(rankings, places, {case_of_row(table, row), table.value(row, "integrand"), roulette, {}})
              .competitors.push_back(competitor_of(table, row, ray_ns));
  }
  for (Ranking& ranking : rankings) ranking.competitors = ranked(std::move(ranking.competitors));
  return rankings;
}

std::map<std::string, WinCount> count_wins(const std::vector<Ranking>& rankings, bool roulette) {
  std::map<std::string, WinCount> counts;
  for (const Ranking& ranking : rankings) {
    if (ranking.roulette != roulette) continue;
    const bool tie = ranking.winners().size() > 1;
    for (const Competitor& c : ranking.competitors) {
      if (!c.compared()) continue;
      WinCount& count = counts[c.strategy];
      if (c.wins()) ++(tie ? count.tied : count.best);
      count.slowest = std::max(count.slowest, c.factor);
    }
  }
  return counts;
}

void write_rankings(const std::filesystem::path& folder, const std::string& name,
                    const std::vector<Ranking>& rankings, double ray_ns) {
  CsvFile csv(
      folder, name,
      "kd,ks,n,theta_deg,integrand,roulette,strategy,relative_variance,relative_variance_standard_error,"
      "ray_ns,cost_ns,cost_standard_error,factor,factor_least,factor_most,verdict");
  for (const Ranking& ranking : rankings) {
    const bool tie = ranking.winners().size() > 1;
    for (const Competitor& c : ranking.competitors) {
      const std::string verdict = !c.compared() ? c.marks : !c.wins() ? "slower" : tie ? "tied" : "best";
      const std::string factors =
          c.compared() ? fmt::format("{:.5g},{:.5g},{:.5g}", c.factor, c.least, c.most) : ",,";
      csv.line(fmt::format("{},{},{},{},{:.6g},{:.4g},{:.5g},{:.6g},{:.4g},{},{}", ranking.one, ranking.light,
                           ranking.roulette ? 1 : 0, c.strategy, c.variance, c.variance_standard_error,
                           ray_ns, c.cost, c.cost_standard_error, factors, verdict));
    }
  }
}

} // namespace phlux::bench
