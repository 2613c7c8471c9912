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

#include "measure/moments.h"
#include "measure/statistics.h"

namespace phlux::bench {
namespace {

constexpr double false_alarm_rate = 0.05; // of all intervals of a ranking together
constexpr int resamples = 20'000;
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

// `cost.cost` is set.
void set_ratio(RankedCost& cost, const MethodResult& result, const MethodResult& best, CostClock clock,
               double level) {
  const std::size_t count = result.rounds.size();
  if (!(best.variance.value > 0)) { // all its images are exact
    cost.ratio = cost.low = cost.high = cost.cost > 0 ? INFINITY : 1;
    return;
  }
  cost.ratio = cost.cost / cost_in(best, clock, all_rounds(count));
  std::mt19937_64 random(resampling_seed);
  std::vector<double> ratios;
  Rounds rounds(count);
  while (ratios.size() < resamples) {
    for (std::size_t& round : rounds) round = random() % count;
    ratios.push_back(cost_in(result, clock, rounds) / cost_in(best, clock, rounds));
  }
  std::ranges::sort(ratios);
  const auto below = static_cast<std::size_t>(lower_tail(level, count) * resamples);
  cost.low = ratios[below], cost.high = ratios[ratios.size() - 1 - below];
}

bool has_cost(const MethodResult& result) {
  return result.verdict != Verdict::refused && result.verdict != Verdict::biased;
}

Rank rank_of(const RankedCost& cost, Verdict verdict) {
  const bool slower = cost.low > 1;
  if (verdict == Verdict::sound) return slower ? Rank::slower : Rank::tied;
  return slower ? Rank::none : Rank::open;
}

std::string factor(const RankedCost& cost) {
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", cost.ratio, cost.low, cost.high);
}

// A, B and C
std::string list_of(const std::vector<std::string>& names) {
  if (names.size() == 1) return names[0];
  const std::vector<std::string> first(names.begin(), names.end() - 1);
  return fmt::format("{} and {}", fmt::join(first, ", "), names.back());
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
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!has_cost(results[i])) continue;
    set_ratio(costs[i], results[i], results[*best], clock, level);
    costs[i].rank = i == *best ? Rank::best : rank_of(costs[i], results[i].verdict);
  }
  return costs;
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
  std::vector<std::string> fastest, slower, open;
  double soonest = INFINITY, longest = 2; // factors of the time
  for (const std::size_t i : order) {
    const std::string name = options_of(results[i].method);
    const Rank rank = costs[i].rank;
    if (rank == Rank::best) fastest.insert(fastest.begin(), name);
    if (rank == Rank::tied) fastest.push_back(name + ", " + factor(costs[i]));
    if (rank == Rank::slower) slower.push_back(name + ", needs " + factor(costs[i]) + " times as long");
    if (rank == Rank::open) {
      open.push_back(name);
      soonest = std::min(soonest, std::max(2.0, results[i].times_longer));
      longest = std::max(longest, results[i].times_longer);
    }
  }
  if (fastest.empty() && open.empty()) return "no method is right";
  if (fastest.empty())
    return fmt::format("too little time to tell which method is best: --seconds {:.2g} or more",
                       seconds * soonest);
  std::string text;
  if (!open.empty())
    text = fmt::format(
        "too little time to tell whether {} {} less time for the same error: --seconds {:.2g} or more",
        list_of(open), open.size() == 1 ? "needs" : "need", seconds * longest);
  if (!open.empty()) text += "; of the others, ";
  const std::string what = open.empty() ? "the least time for the same error" : "the least time";
  text += fastest.size() == 1 ? fmt::format("{} needs {}", fastest[0], what)
                              : fmt::format("tied for {}: {}", what, fmt::join(fastest, "; "));
  return text + (slower.empty() ? "; no other method is known to be right" : "; the next, " + slower[0]);
}

} // namespace phlux::bench
