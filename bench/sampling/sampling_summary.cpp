#include "bench/sampling/sampling_summary.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "bench/sampling/sampling_table.h"
#include "measure/moments.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

struct Summary {
  double largest_bias = 0; // in standard errors
  int defects = 0, rows = 0, marked = 0;
  std::vector<double> relative_times; // to lobe-ks in the same case
};

std::map<std::string, Summary> summaries_of(const SavedTable& table) {
  const auto number = [&](const SavedTable::Row& row, const char* column) {
    return std::stod(table.value(row, column));
  };
  std::map<std::string, Summary> summaries;
  for (const auto& [integral, rows] : rows_by_integral(table)) {
    const auto lobe_ks =
        std::ranges::find_if(rows, [](const SavedTable::Row& row) { return row.front() == "lobe-ks"; });
    for (const SavedTable::Row& row : rows) {
      Summary& summary = summaries[row.front()];
      const double bias = number(row, "bias_sigma");
      const std::string& marks = table.value(row, "marks");
      if (std::abs(bias) > std::abs(summary.largest_bias) && marks.find("unresolved") == std::string::npos)
        summary.largest_bias = bias;
      summary.defects += number(row, "defects") > 0 ? 1 : 0;
      ++summary.rows;
      if (lobe_ks != rows.end())
        summary.relative_times.push_back(number(row, "ns_per_sample") / number(*lobe_ks, "ns_per_sample"));
      if (!marks.empty()) ++summary.marked;
    }
  }
  return summaries;
}

} // namespace

void print_sampling_summary(const std::vector<std::string>& strategies, const SavedTable& table,
                            const std::vector<Ranking>& rankings) {
  const auto summaries = summaries_of(table);
  auto without = count_wins(rankings, false), with = count_wins(rankings, true);
  const auto text = [](const WinCount& count) { return fmt::format("{} + {}", count.best, count.tied); };
  say("{:<22} {:>6} {:>7} {:>20} {:>8} {:>24} {:>24} {:>14}\n", "strategy", "rows", "marked",
      "largest bias / sigma", "defects", "time / lobe-ks (median)", "best + tied: no roulette",
      "with roulette");
  for (const std::string& strategy : strategies) {
    const auto found = summaries.find(strategy);
    if (found == summaries.end()) continue;
    const Summary& s = found->second;
    say("{:<22} {:>6} {:>7} {:>20.2f} {:>8} {:>24} {:>24} {:>14}\n", strategy, s.rows, s.marked,
        s.largest_bias, s.defects,
        s.relative_times.empty() ? "" : fmt::format("{:.2f}", measure::median(s.relative_times)),
        text(without[strategy]), text(with[strategy]));
  }
}

} // namespace phlux::bench
