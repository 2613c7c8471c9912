// What a device hands over of light paths and bidirectional paths: records of splats, folded into the film.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "film/film.h"

namespace phlux::film {

/// One batch's records as the device wrote them: arrays of `capacity` words each, of which the first `count`
/// hold (kernels/scene_data.h, RecordWords).
struct SplatRecords {
  const float* words = nullptr;
  std::size_t capacity = 0, count = 0;
  std::size_t paths = 0; ///< of the batch: its records name paths below that
};

/// Adds up what each path brought to each pixel before it goes to the film, which wants the squares of that.
class SplatFolder {
public:
  void fold(const SplatRecords& records, Film& film);

private:
  struct Entry {
    std::size_t pixel;
    std::array<double, 3> value;
    std::int32_t earlier; ///< entry of the same path, -1: none
  };
  std::vector<Entry> entries_;
  std::vector<std::int32_t> last_; ///< per path: its latest entry
};

} // namespace phlux::film
