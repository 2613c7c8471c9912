// Comparison of two means of a few values each.
#pragma once

namespace phlux::test {

/// Two-sided p of Welch's test (1947) of two means of `renders` values each, given the variances of the
/// means; 1 where they differ by no more than rounding.
[[nodiscard]] double welch_p(double a, double variance_a, double b, double variance_b, int renders);

} // namespace phlux::test
