#include "bench/sampling/sampling_verdict.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/common/enumeration.h"
#include "settings/settings.h"

namespace phlux::bench {
namespace {

constexpr double largest_factor = 1000; // factors above are not distinguished
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string condition_text(bool roulette) {
  return roulette
             ? "with roulette at every bounce (--rr-depth 1)"
             : fmt::format("without roulette (the default before edge {})", settings::Settings{}.rr_depth);
}

std::string cost_text(const VerdictConditions& conditions) {
  return fmt::format("cost: {} time of the sampler plus {:.3g} ns for each reflected ray; {}",
                     conditions.clock == CostClock::processor ? "processor" : "device", conditions.ray_ns,
                     conditions.device);
}

// A factor with its interval, in as many decimals as the interval leaves certain, and so that no end is
// rounded to 1.
std::string times_text(double factor, double least, double most) {
  if (factor > largest_factor) return fmt::format("over {:.0f} times", largest_factor);
  const double certain = std::min(most - least, std::abs(least - 1));
  const int decimals = factor >= 10 && least >= 2 ? 0 : certain >= 0.01 ? 2 : certain >= 0.001 ? 3 : 4;
  return fmt::format("{0:.{3}f} times (95%: {1:.{3}f} to {2:.{3}f})", factor, least, most, decimals);
}

std::string times_text(const Competitor& c) {
  return times_text(c.factor, c.least, c.most);
}

const Competitor* find(const Ranking& ranking, const std::string& strategy) {
  const auto found = std::ranges::find(ranking.competitors, strategy, &Competitor::strategy);
  return found != ranking.competitors.end() && found->compared() ? &*found : nullptr;
}

// How `chosen` compares with the others in one ranking.
std::string result_text(const Ranking& ranking, const std::string& chosen) {
  const Competitor& best = ranking.competitors.front();
  const Competitor* const c = find(ranking, chosen);
  if (c == nullptr) return "not compared";
  if (!c->wins()) return fmt::format("{} the time of {}", times_text(*c), best.strategy);
  std::vector<std::string> ties;
  for (const Competitor& other : ranking.winners())
    if (other.strategy != chosen) ties.push_back(other.strategy);
  if (best.constant()) return ties.empty() ? "no variance" : "no variance, like " + enumeration(ties);
  if (!ties.empty()) {
    const Competitor& second = *find(ranking, ties.front());
    const bool first = chosen == best.strategy;
    return fmt::format("tied with {}, at {} the efficiency of {}", enumeration(ties),
                       first ? times_text(second) : times_text(1 / c->factor, 1 / c->most, 1 / c->least),
                       second.strategy);
  }
  if (ranking.competitors.size() < 2 || !ranking.competitors[1].compared()) return "the only one compared";
  return fmt::format("{} as efficient as {}", times_text(ranking.competitors[1]),
                     ranking.competitors[1].strategy);
}

// The strategy that wins in all of these rankings; if there is none or are several, the one that is nearest
// the best where it is furthest from it.
struct Choice {
  std::string strategy;
  bool wins = false;          // in all
  double furthest = infinity; // from the best: a factor
};

Choice choice_of(const std::vector<Ranking>& rankings) {
  Choice choice;
  for (const Competitor& candidate : rankings.front().competitors) {
    Choice other{candidate.strategy, true, 1};
    for (const Ranking& ranking : rankings) {
      const Competitor* const c = find(ranking, candidate.strategy);
      other.wins = other.wins && c != nullptr && c->wins();
      other.furthest = std::max(other.furthest, c != nullptr ? c->factor : infinity);
    }
    if (choice.strategy.empty() ||
        std::pair(!other.wins, other.furthest) < std::pair(!choice.wins, choice.furthest))
      choice = other;
  }
  return choice;
}

// On one case under each kind of light, all with or all without roulette.
std::string on_condition(std::vector<Ranking> rankings, const std::string& option) {
  const std::string condition = condition_text(rankings.front().roulette);
  std::erase_if(rankings, [](const Ranking& r) { return r.winners().empty(); });
  if (rankings.empty())
    return fmt::format("no strategy can be compared {}: more --samples are needed", condition);
  const Choice choice = choice_of(rankings);
  std::vector<std::string> results;
  for (const Ranking& ranking : rankings)
    results.push_back(fmt::format("{} in {} light", result_text(ranking, choice.strategy), ranking.light));
  return fmt::format("{}{}{}{}: {}", option, choice.strategy,
                     choice.wins ? " " : ", the safest choice for these lights, ", condition,
                     fmt::join(results, "; "));
}

// Those of this case and condition in which strategies can be compared.
std::vector<Ranking> selected(const std::vector<Ranking>& rankings, const std::string& one, bool roulette) {
  std::vector<Ranking> some;
  std::ranges::copy_if(rankings, std::back_inserter(some), [&](const Ranking& r) {
    return (one.empty() || r.one == one) && r.roulette == roulette && r.competitors.size() > 1;
  });
  return some;
}

// On all rankings of one condition.
std::string on_all(const std::vector<Ranking>& rankings, const std::string& option) {
  const std::string condition = condition_text(rankings.front().roulette);
  const std::map<std::string, WinCount> counts = count_wins(rankings, rankings.front().roulette);
  std::vector<std::pair<std::string, WinCount>> order(counts.begin(), counts.end());
  std::erase_if(order, [](const auto& entry) { return entry.second.best + entry.second.tied == 0; });
  if (order.empty())
    return fmt::format("no strategy can be compared {}: more --samples are needed", condition);
  std::ranges::sort(order, std::greater{}, [](const auto& entry) {
    return std::pair(entry.second.best + entry.second.tied, entry.second.best);
  });
  std::vector<std::string> others;
  for (auto entry = order.begin() + 1; entry != order.end(); ++entry)
    others.push_back(fmt::format("{} ({}, {})", entry->first, entry->second.best, entry->second.tied));
  const auto& [answer, count] = order.front();
  std::string slowest;
  if (count.slowest > 1)
    slowest = fmt::format("; takes {} times as long as the best",
                          count.slowest > largest_factor ? fmt::format("over {:.0f}", largest_factor)
                                                         : fmt::format("at most {:.3g}", count.slowest));
  return fmt::format("{}{} {}: best in {} and tied in {} of {} cases{}{}{}", option, answer, condition,
                     count.best, count.tied, rankings.size(), slowest,
                     others.empty() ? "" : "; next (best, tied): ", fmt::join(others, ", "));
}

} // namespace

std::vector<std::string> verdicts_on_cases(const std::vector<Ranking>& rankings,
                                           const VerdictConditions& conditions) {
  std::vector<std::string> cases, sentences;
  for (const Ranking& ranking : rankings)
    if (std::ranges::count(cases, ranking.one) == 0) cases.push_back(ranking.one);
  for (const std::string& one : cases) {
    std::vector<std::string> parts;
    for (const bool roulette : {false, true})
      if (const auto some = selected(rankings, one, roulette); !some.empty())
        parts.push_back(on_condition(some, conditions.option));
    if (!parts.empty())
      sentences.push_back(
          fmt::format("{} (--case {}; {})", fmt::join(parts, ";\n"), one, cost_text(conditions)));
  }
  return sentences;
}

std::string verdict_on_grid(const std::vector<Ranking>& rankings, const VerdictConditions& conditions) {
  std::vector<std::string> parts;
  for (const bool roulette : {false, true})
    if (const auto some = selected(rankings, "", roulette); !some.empty())
      parts.push_back(on_all(some, conditions.option));
  if (parts.empty()) return "";
  return fmt::format("{} (a case: a material, angle and light; {})", fmt::join(parts, ";\n"),
                     cost_text(conditions));
}

} // namespace phlux::bench
