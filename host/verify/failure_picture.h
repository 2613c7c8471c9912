// The picture of a failed check whose figures are on a square grid.
#pragma once

#include "files/canvas.h"
#include "verify/report.h"

namespace phlux::verify {

/// The drawn columns of the histogram side by side, by one colour scale, and the first less the last by
/// another; with titles, axes and both scales. `histogram.side` > 0.
[[nodiscard]] files::Canvas failure_picture(const Result& result);

} // namespace phlux::verify
