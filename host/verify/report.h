// The results of a verification: one per strategy and check, with histograms of those that failed.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace phlux::verify {

/// Probability of a false alarm of a whole verification, over all seeds. As seeds are fixed, a verification
/// that passes on a device always passes there.
inline constexpr double false_alarm_rate = 1e-4;

/// Expected and observed values per cell; written to a file when its check fails.
struct Histogram {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  std::size_t side = 0; ///< side of the square grid of which the rows are cells; 0: no grid, no picture
  // With a grid: the first two columns are the cells' coordinates.
  std::vector<std::size_t> drawn; ///< columns to draw side by side: observed values first, expected ones last
  std::string quantity{};         ///< what they are
};

/// A p-value below is worth a closer look: a histogram, a diagnosis.
inline constexpr double suspicious_p = 1e-4;

enum class Sense {
  at_most,    ///< the largest figure must not exceed the limit
  probability ///< the smallest p-value must exceed the limit, which is Sidak's for all p-values of the run
};

struct Result {
  std::string strategy; ///< or the name of a method of an integrator; empty: of the model
  std::string check;
  Sense sense = Sense::at_most;
  double worst = 0, limit = 0;
  std::size_t seen = 0;    ///< number of figures
  std::string where, note; ///< of the worst figure
  std::string look_at;     ///< kernel function and file, where more is known than meaning_of says
  Histogram histogram;     ///< of the worst p-value
  bool passed = true;
  std::vector<std::string> files; ///< written by write_failures
};

class Report {
public:
  /// Records a figure of a check. Figures that are not finite fail.
  void record(const std::string& strategy, const std::string& check, double figure, double limit,
              const std::string& where);
  /// Records a p-value; returns whether it is the smallest so far and suspicious, so that its histogram
  /// should be kept.
  bool record_p(const std::string& strategy, const std::string& check, double p, const std::string& where);
  void keep(const std::string& strategy, const std::string& check, Histogram histogram);
  void note(const std::string& strategy, const std::string& check, const std::string& text);
  void look_at(const std::string& strategy, const std::string& check, const std::string& function);

  /// Compares all results with their limits; to be called when all p-values are recorded.
  void judge();
  [[nodiscard]] bool passed() const;
  [[nodiscard]] std::size_t p_values() const { return p_values_; } ///< their number
  [[nodiscard]] const std::vector<Result>& results() const { return results_; }
  [[nodiscard]] std::vector<Result>& results() { return results_; }

private:
  Result& at(const std::string& strategy, const std::string& check, Sense sense);
  std::vector<Result> results_;
  std::map<std::pair<std::string, std::string>, std::size_t> index_;
  std::size_t p_values_ = 0;
};

} // namespace phlux::verify
