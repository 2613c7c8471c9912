// What verification found: one result per strategy and check, and the histograms of those that failed.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace phlux::verify {

/// A verification raises a false alarm with this probability, were its seeds drawn anew. They are fixed: what
/// passes on a device keeps passing there.
inline constexpr double false_alarm_rate = 1e-4;

/// What was expected and what was seen in each cell; written to a file when its check fails.
struct Histogram {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  std::size_t side = 0;           ///< of a square grid whose rows these are, for a picture; 0: no picture
  std::vector<std::size_t> drawn; ///< columns to draw beside each other
};

enum class Sense {
  at_most,    ///< the largest figure counts and must not exceed the limit
  probability ///< the smallest p-value counts; the limit is Sidak's, for all p-values of the run
};

struct Result {
  std::string strategy; ///< empty: of the model, whatever the strategy
  std::string check;
  Sense sense = Sense::at_most;
  double worst = 0, limit = 0;
  std::size_t seen = 0;    ///< figures that `worst` is the worst of
  std::string where, note; ///< of the worst figure
  Histogram histogram;     ///< of the worst p-value
  bool passed = true;
  std::vector<std::string> files; ///< what was written about the failure
};

class Report {
public:
  /// Sees one figure of a check. Figures that are not finite fail.
  void see(const std::string& strategy, const std::string& check, double figure, double limit,
           const std::string& where);
  /// Sees one p-value; returns whether it is so bad that its histogram is worth keeping.
  bool see_p(const std::string& strategy, const std::string& check, double p, const std::string& where);
  void keep(const std::string& strategy, const std::string& check, Histogram histogram);
  void note(const std::string& strategy, const std::string& check, const std::string& text);

  /// Compares all with their limits, now that the number of p-values is known.
  void judge();
  [[nodiscard]] bool passed() const;
  [[nodiscard]] std::size_t questions() const { return questions_; } ///< p-values seen
  [[nodiscard]] const std::vector<Result>& results() const { return results_; }
  [[nodiscard]] std::vector<Result>& results() { return results_; }

private:
  Result& at(const std::string& strategy, const std::string& check, Sense sense);
  std::vector<Result> results_;
  std::map<std::pair<std::string, std::string>, std::size_t> index_;
  std::size_t questions_ = 0;
};

} // namespace phlux::verify
