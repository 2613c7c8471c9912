#include "images/welch.h"

#include <algorithm>
#include <cmath>

#include "images/agreement.h"
#include "measure/statistics.h"

namespace phlux::test {

double welch_p(double a, double variance_a, double b, double variance_b, int renders) {
  const double variance = variance_a + variance_b, difference = std::abs(a - b);
  if (difference <= rounding * std::max(std::abs(a), std::abs(b))) return 1;
  if (variance <= 0) return 0;
  const double freedom =
      (renders - 1) * variance * variance / (variance_a * variance_a + variance_b * variance_b);
  return measure::student_p(difference / std::sqrt(variance), std::max(freedom, 1.0));
}

} // namespace phlux::test
