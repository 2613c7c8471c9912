#include "tables/alias_table.h"

#include <algorithm>
#include <numeric>

namespace phlux::tables {

AliasTable alias_table(std::vector<double> probabilities) {
  AliasTable table{std::move(probabilities), {}};
  std::vector<double>& scaled = table.keep;
  table.alias.resize(scaled.size());
  std::iota(table.alias.begin(), table.alias.end(), 0);
  if (scaled.empty()) return table;
  const auto likeliest = static_cast<int>(std::ranges::max_element(scaled) - scaled.begin());
  const auto at = [&](int i) -> double& { return scaled[static_cast<std::size_t>(i)]; };
  std::vector<int> small, large;
  for (const int i : table.alias) {
    at(i) *= static_cast<double>(scaled.size());
    (at(i) < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const int less = small.back(), more = large.back();
    small.pop_back();
    table.alias[static_cast<std::size_t>(less)] = more;
    at(more) -= 1 - at(less);
    if (at(more) < 1) {
      large.pop_back();
      small.push_back(more);
    }
  }
  // What rounding has left over.
  for (const int i : large) at(i) = 1;
  for (const int i : small) table.alias[static_cast<std::size_t>(i)] = likeliest;
  return table;
}

} // namespace phlux::tables
