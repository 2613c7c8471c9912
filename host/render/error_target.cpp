#include "render/error_target.h"

#include <algorithm>
#include <cmath>

#include "film/reliability.h"

namespace phlux::render {
namespace {

constexpr double margin = 1.01; // of the predicted paths, so that one more computation is rarely needed

} // namespace

ErrorTarget::ErrorTarget(double error, std::size_t pixels)
    : error_(error), wanted_paths_(film::least_samples * static_cast<double>(pixels)) {}

bool ErrorTarget::reached(const film::Film& film, std::uint64_t paths) {
  const auto done = static_cast<double>(paths);
  if (film.samples_per_pixel() < film::least_samples || (done < wanted_paths_ && Clock::now() < next_check_))
    return false;
  const Clock::time_point begin = Clock::now();
  const double error = film.relative_standard_error();
  next_check_ = Clock::now() + 50 * (Clock::now() - begin);
  const double ratio = error / error_;
  wanted_paths_ = done * std::min(2.0, margin * ratio * ratio);
  return ratio <= 1;
}

} // namespace phlux::render
