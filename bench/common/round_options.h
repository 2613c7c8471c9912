// Options of measurements by rounds: every method renders the same number of samples with every seed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/common/options.h"

namespace phlux::bench {

struct RoundOptions : CommonOptions {
  std::vector<std::filesystem::path> scenes; ///< empty: those that ship
  bool quick = false;                        ///< smaller images, fewer samples and rounds
  int samples = 0;                           ///< per pixel and round; 0: the default
  std::uint64_t seed = 1;                    ///< of the first round
  std::function<bool()> interrupted;         ///< may be empty

  /// Largest side of the images, in pixels.
  [[nodiscard]] int side() const { return quick ? 32 : 64; }
  [[nodiscard]] int rounds() const { return quick ? quick_rounds : 10; }
  /// Per pixel and round.
  [[nodiscard]] int round_samples() const { return samples > 0 ? samples : quick ? 16 : 64; }
  /// The command that repeats the measurement. `more`: its own options, each with a space before it.
  [[nodiscard]] std::string command(const std::string& name, const std::string& more) const;
  /// The first and the last of `count` seeds: "1 to 10".
  [[nodiscard]] std::string seeds(int count) const;

protected:
  int quick_rounds = 6;
};

/// " --option VALUE" for each value, unless they are the default ones.
[[nodiscard]] std::string text_of_values(const char* option, const std::vector<std::string>& values,
                                         const std::vector<std::string>& defaults);

} // namespace phlux::bench
