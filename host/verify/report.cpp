#include "verify/report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/statistics.h"

namespace phlux::verify {

Result& Report::at(const std::string& strategy, const std::string& check, Sense sense) {
  const auto [found, is_new] = index_.try_emplace({strategy, check}, results_.size());
  if (is_new) {
    Result result;
    result.strategy = strategy;
    result.check = check;
    result.sense = sense;
    result.worst = sense == Sense::probability ? 2 : -1; // any figure is worse
    results_.push_back(std::move(result));
  }
  return results_[found->second];
}

void Report::record(const std::string& strategy, const std::string& check, double figure, double limit,
                    const std::string& where) {
  Result& result = at(strategy, check, Sense::at_most);
  ++result.seen;
  const double counted = std::isfinite(figure) ? figure : std::numeric_limits<double>::infinity();
  if (counted <= result.worst) return;
  result.worst = counted;
  result.limit = limit;
  result.where = where;
}

bool Report::record_p(const std::string& strategy, const std::string& check, double p,
                      const std::string& where) {
  Result& result = at(strategy, check, Sense::probability);
  ++result.seen;
  ++p_values_;
  const double counted = std::isfinite(p) ? p : 0;
  if (counted >= result.worst) return false;
  result.worst = counted;
  result.where = where;
  return counted < suspicious_p;
}

void Report::keep(const std::string& strategy, const std::string& check, Histogram histogram) {
  at(strategy, check, Sense::probability).histogram = std::move(histogram);
}

void Report::note(const std::string& strategy, const std::string& check, const std::string& text) {
  at(strategy, check, Sense::at_most).note = text;
}

void Report::look_at(const std::string& strategy, const std::string& check, const std::string& function) {
  at(strategy, check, Sense::at_most).look_at = function;
}

void Report::judge() {
  for (Result& result : results_) {
    if (result.sense == Sense::probability) result.limit = measure::sidak_limit(false_alarm_rate, p_values_);
    result.passed =
        result.sense == Sense::probability ? result.worst > result.limit : result.worst <= result.limit;
  }
}

bool Report::passed() const {
  return std::all_of(results_.begin(), results_.end(), [](const Result& result) { return result.passed; });
}

} // namespace phlux::verify
