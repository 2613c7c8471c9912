// What a comparison of images that fails leaves behind to look at.
#pragma once

#include <string>

#include "images/agreement.h"

namespace phlux::test {

/// Writes four EXR files, named after the running test case and counted: NAME.image.exr, NAME.reference.exr,
/// NAME.variance.exr (of their difference, per pixel and channel) and NAME.p.exr (of agreement()'s tests of
/// pixels, one by one: not corrected). Images of different sizes have no p. Returns a line that names them.
[[nodiscard]] std::string leave_evidence(const Estimate& image, const Estimate& reference,
                                         double tolerance = rounding);

/// CHECKs the result of agreement() or agreement_of_pixels() of these two images, with its message, and
/// leaves evidence where they do not agree.
void check(const Agreement& result, const Estimate& image, const Estimate& reference,
           double tolerance = rounding);

/// CHECKs agreement().
void check_agreement(const Estimate& image, const Estimate& reference, double tolerance = rounding);
/// CHECKs agreement_of_pixels().
void check_agreement_of_pixels(const Estimate& image, const Estimate& reference, double tolerance = rounding);

} // namespace phlux::test
