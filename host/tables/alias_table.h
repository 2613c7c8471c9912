// The alias method: sampling of a discrete distribution in constant time (Walker 1974; Vose 1991).
#pragma once

#include <vector>

namespace phlux::tables {

/// Cell i, chosen uniformly, gives i with probability keep[i], else alias[i].
struct AliasTable {
  std::vector<double> keep; ///< in [0, 1]
  std::vector<int> alias;
};

/// The table of probabilities whose sum is 1, by Vose's construction. An entry of probability 0 is never
/// chosen.
[[nodiscard]] AliasTable alias_table(std::vector<double> probabilities);

} // namespace phlux::tables
