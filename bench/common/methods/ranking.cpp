#include "bench/common/methods/ranking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <random>

#include <boost/math/distributions/normal.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/common/enumeration.h"
#include "measure/moments.h"
#include "measure/statistics.h"

namespace phlux::bench {
namespace {

constexpr double false_alarm_rate = 0.05; // of all intervals of a ranking together
constexpr std::size_t resample_count = 20'000;
constexpr std::uint64_t resampling_seed = 1;

using Rounds = std::vector<std::size_t>; // indices, with repetitions

double seconds_of(const RoundCost& round, CostClock clock) {
  return clock == CostClock::processor ? round.processor_seconds : round.seconds;
}

double cost_in(const MethodResult& result, CostClock clock, const Rounds& rounds) {
  double variance = 0;
  std::vector<double> seconds;
  for (const std::size_t round : rounds) {
    variance += result.rounds[round].variance;
    seconds.push_back(seconds_of(result.rounds[round], clock));
  }
  return variance / static_cast<double>(rounds.size()) * measure::median(std::move(seconds));
}

Rounds all_rounds(std::size_t count) {
  Rounds rounds(count);
  std::iota(rounds.begin(), rounds.end(), std::size_t{0});
  return rounds;
}

// The share of the resamples below the interval. A percentile interval of n values is too narrow by
// sqrt((n - 1) / n) and has the quantile of the normal distribution instead of Student's.
double lower_tail(double level, std::size_t rounds) {
  const auto n = static_cast<double>(rounds);
  return boost::math::cdf(boost::math::normal(), -std::sqrt(n / (n - 1)) * measure::student_t(level, n - 1));
}

// Costs of a method in each of the resamples of the rounds.
std::vector<double> resampled_costs(const MethodResult& result, CostClock clock,
                                    const std::vector<Rounds>& resamples) {
  std::vector<double> costs;
  for (const Rounds& rounds : resamples) costs.push_back(cost_in(result, clock, rounds));
  return costs;
}

std::vector<Rounds> resamples_of(std::size_t rounds) {
  std::mt19937_64 random(resampling_seed);
  std::vector<Rounds> resamples(resample_count, Rounds(rounds));
  for (Rounds& resample : resamples)
    for (std::size_t& round : resample) round = random() % rounds;
  return resamples;
}

// `cost.cost` and `best_cost` are those of all rounds, the vectors those of the resamples.
void set_ratio(RankedCost& cost, double best_cost, std::vector<double> costs,
               const std::vector<double>& best_costs, double tail) {
  cost.ratio = cost.cost / best_cost;
  std::ranges::transform(costs, best_costs, costs.begin(), std::divides<>());
  std::ranges::sort(costs);
  const auto below = static_cast<std::size_t>(tail * static_cast<double>(costs.size()));
  cost.low = costs[below], cost.high = costs[costs.size() - 1 - below];
}

// To two digits.
double rounded(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return std::round(value / unit) * unit;
}

// An end of an interval to three digits, or more if it would be rounded to 1.
std::string text_of_end(double end) {
  int digits = 3;
  while (digits < 6 && end != 1 && fmt::format("{:.{}g}", end, digits) == "1") ++digits;
  return fmt::format("{:.{}g}", end, digits);
}

bool has_cost(const MethodResult& result) {
  return result.verdict != Verdict::refused && result.verdict != Verdict::biased;
}

Rank rank_of(const RankedCost& cost, Verdict verdict) {
  const bool slower = cost.low > 1;
  if (verdict == Verdict::sound) return slower ? Rank::slower : Rank::tied;
  return slower ? Rank::none : Rank::open;
}

} // namespace

CostClock clock_of(const device::DeviceInfo& device) {
  return device.type == "cpu" ? CostClock::processor : CostClock::wall;
}

const char* word_of(CostClock clock) {
  return clock == CostClock::processor ? "processor" : "wall";
}

const char* word_of(Rank rank) {
  constexpr std::array<const char*, 5> words = {"best", "tied", "slower", "open", ""};
  return words[static_cast<std::size_t>(rank)];
}

std::vector<RankedCost> rank(const std::vector<MethodResult>& results, CostClock clock) {
  std::vector<RankedCost> costs(results.size());
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].verdict == Verdict::refused) continue;
    costs[i].cost = cost_in(results[i], clock, all_rounds(results[i].rounds.size()));
    if (results[i].verdict == Verdict::sound && (!best || costs[i].cost < costs[*best].cost)) best = i;
  }
  if (!best) {
    for (std::size_t i = 0; i < results.size(); ++i)
      if (has_cost(results[i])) costs[i].rank = Rank::open;
    return costs;
  }
  const auto others = static_cast<std::size_t>(std::ranges::count_if(results, has_cost) - 1);
  const double level = measure::sidak_limit(false_alarm_rate, std::max<std::size_t>(1, others));
  const std::size_t rounds = results[*best].rounds.size();
  const std::vector<Rounds> resamples = resamples_of(rounds);
  const std::vector<double> best_costs = resampled_costs(results[*best], clock, resamples);
  const double tail = lower_tail(level, rounds);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!has_cost(results[i])) continue;
    if (results[*best].variance.value > 0)
      set_ratio(costs[i], costs[*best].cost, resampled_costs(results[i], clock, resamples), best_costs, tail);
    else // all images of the best one are exact
      costs[i].ratio = costs[i].low = costs[i].high = costs[i].cost > 0 ? INFINITY : 1;
    costs[i].rank = i == *best ? Rank::best : rank_of(costs[i], results[i].verdict);
  }
  return costs;
}

std::string text_of_ratio(const RankedCost& cost) {
  return fmt::format("{:.3g} ({} to {})", cost.ratio, text_of_end(cost.low), text_of_end(cost.high));
}

std::string options_of(const Method& method) {
  std::string text = "-i " + method.integrator;
  if (method.integrator == "path") text += " --connect " + method.variant;
  if (method.integrator == "bidir") text += " --weights " + method.variant;
  if (method.strategy != render::Settings().strategy) text += " --strategy " + method.strategy;
  return text;
}

std::string answer_of(const std::vector<MethodResult>& results, const std::vector<RankedCost>& costs,
                      double seconds) {
  std::vector<std::size_t> order(results.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return std::isnan(costs[i].cost); });
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return costs[i].cost; });
  std::vector<std::string> fastest, slower, open, ahead; // ahead: open, and so far less than the best
  double soonest = INFINITY, longest = 2;                // factors of the time
  for (const std::size_t i : order) {
    const std::string name = options_of(results[i].method);
    const Rank rank = costs[i].rank;
    if (rank == Rank::best) fastest.insert(fastest.begin(), name);
    if (rank == Rank::tied) fastest.push_back(name + ", " + text_of_ratio(costs[i]));
    if (rank == Rank::slower)
      slower.push_back(name + ", needs " + text_of_ratio(costs[i]) + " times as long");
    if (rank == Rank::open) {
      open.push_back(name);
      if (costs[i].high < 1 && costs[i].cost > 0) // 0: no sample found light
        ahead.push_back(name + " needed " + text_of_ratio(costs[i]));
      soonest = std::min(soonest, std::max(2.0, results[i].times_longer));
      longest = std::max(longest, results[i].times_longer);
    }
  }
  if (fastest.empty() && open.empty()) return "no method is sound";
  if (fastest.empty())
    return fmt::format("too little time to tell which method is best: --seconds {:g} or more",
                       rounded(seconds * soonest));
  std::string text;
  if (!open.empty())
    text = fmt::format(
        "too little time to tell whether {} {} less time for the same error: --seconds {:g} or more",
        enumeration(open), open.size() == 1 ? "needs" : "need", rounded(seconds * longest));
  if (!open.empty()) text += "; of the others, ";
  const std::string what = open.empty() ? "the least time for the same error" : "the least time";
  text += fastest.size() == 1 ? fmt::format("{} needs {}", fastest[0], what)
                              : fmt::format("tied for {}: {}", what, fmt::join(fastest, "; "));
  if (!ahead.empty()) text += fmt::format("; so far {} times as long as the best of these", ahead[0]);
  return text + (slower.empty() ? "; no other method is known to be sound" : "; the next, " + slower[0]);
}

} // namespace phlux::bench
