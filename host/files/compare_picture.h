// Two images and their difference in false colours, side by side.
#pragma once

#include <string>
#include <vector>

#include "files/canvas.h"
#include "files/image.h"

namespace phlux::files {

/// (a-b) / sqrt(b^2 + 1e-4), of the channel R, G or B where its magnitude is largest, for each pixel; NaN
/// where a channel is not finite. Its square is the summand of Comparison::relmse.
[[nodiscard]] std::vector<double> relative_differences(const Image& a, const Image& b);

/// The end of the colour scale for these differences: the 95th percentile of the magnitudes that are finite
/// and not 0, rounded up to 1, 2 or 5 times a power of ten; 0.01 if there are none.
[[nodiscard]] double scale_of(const std::vector<double>& differences);

/// From blue (-1) through white (0) to red (1); beyond, the colours at the ends; green for NaN.
[[nodiscard]] Color false_color(double value);

/// A, B and the false-coloured difference with its scale, each with a title; A and B are exposed as B's
/// preview is. Small images are magnified. `a` and `b` are of one size and have channels R, G and B.
[[nodiscard]] Canvas compare_picture(const Image& a, const Image& b, const std::string& name_a,
                                     const std::string& name_b);

} // namespace phlux::files
