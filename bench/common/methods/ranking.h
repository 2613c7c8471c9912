// Ranks the methods that were measured on one scene by variance x time, with confidence intervals.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "bench/common/methods/method_result.h"
#include "device/device.h"

namespace phlux::bench {

/// Which time a sample costs. On CPUs processor time ranks, as it excludes other programs.
enum class CostClock { wall, processor };

[[nodiscard]] CostClock clock_of(const device::DeviceInfo& device);

/// "wall", "processor".
[[nodiscard]] const char* word_of(CostClock clock);

/// best: the sound method with the least cost. tied: sound, and its interval reaches 1. slower: sound, and
/// its interval does not. open: suspect or undecided, and it may cost less than the best. none: biased,
/// refused, surely slower than the best without being sound, or there is no best.
enum class Rank { best, tied, slower, open, none };

/// "best", "tied", "slower", "open", "".
[[nodiscard]] const char* word_of(Rank rank);

struct RankedCost {
  double cost = std::numeric_limits<double>::quiet_NaN(); ///< variance per sample x seconds per sample
  /// The cost divided by that of the best method, with its 95% interval. Together, all intervals of a ranking
  /// are right with this probability. NaN without a best method, and for biased and refused ones.
  double ratio = std::numeric_limits<double>::quiet_NaN(), low = ratio, high = ratio;
  Rank rank = Rank::none;
};

/// A cost is the mean variance of the rounds x their median time. Intervals by the bootstrap over the rounds,
/// in which the methods are paired: percentiles, expanded for the number of rounds (Hesterberg 2015,
/// section 5.4) and corrected for the number of methods (Sidak 1967).
[[nodiscard]] std::vector<RankedCost> rank(const std::vector<MethodResult>& results, CostClock clock);

/// "1.53 (1.42 to 1.62)": the ratio and its interval.
[[nodiscard]] std::string text_of_ratio(const RankedCost& cost);

/// "-i path --connect mis --strategy exact": the options of `phlux render`.
[[nodiscard]] std::string options_of(const Method& method);

/// The answer: the best method or the tied ones as options, the factor over the next one with its interval,
/// then what may still be better. `seconds` is the time of the measurement, as `--seconds` has it.
[[nodiscard]] std::string answer_of(const std::vector<MethodResult>& results,
                                    const std::vector<RankedCost>& costs, double seconds);

} // namespace phlux::bench
