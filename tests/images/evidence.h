// Images written by failed comparisons, for inspection.
#pragma once

#include <string>

#include "images/agreement.h"

namespace phlux::test {

/// Writes four EXR files, named after the running test case and numbered: NAME.image.exr, NAME.reference.exr,
/// NAME.variance.exr (of their difference, per pixel and channel) and NAME.p.exr (p-values of the tests of
/// pixels, uncorrected). There are no p-values for images of different sizes. Returns a line that names the
/// files.
[[nodiscard]] std::string leave_evidence(const Estimate& image, const Estimate& reference,
                                         double tolerance = rounding);

/// CHECKs the result of agreement() or agreement_of_pixels() of these two images, with its message; writes
/// the files if it fails.
void check(const Agreement& result, const Estimate& image, const Estimate& reference,
           double tolerance = rounding);

/// CHECKs agreement().
void check_agreement(const Estimate& image, const Estimate& reference, double tolerance = rounding);
/// CHECKs agreement_of_pixels().
void check_agreement_of_pixels(const Estimate& image, const Estimate& reference, double tolerance = rounding);

} // namespace phlux::test
