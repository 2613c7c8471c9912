#include "film/techniques.h"

namespace phlux::film {

void Techniques::add(Technique technique, std::size_t pixel, const std::array<double, 3>& radiance,
                     double weight) {
  if (technique.edges() > most_technique_edges) {
    ++left_out_;
    return;
  }
  Sums& sums = sums_[technique];
  if (sums.weighted.empty()) {
    sums.weighted.resize(pixels_);
    sums.unweighted.resize(pixels_);
  }
  ++sums.contributions;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    sums.weighted[pixel][channel] += weight * radiance[channel];
    sums.unweighted[pixel][channel] += radiance[channel];
  }
}

} // namespace phlux::film
