// Ends a render when the error of its film reaches the requested one, and not much later.
#pragma once

#include <cstdint>

#include "clock.h"
#include "film/film.h"

namespace phlux::render {

class ErrorTarget {
public:
  /// `error`: mean relative standard error of the pixels. `pixels` of the film.
  ErrorTarget(double error, std::size_t pixels);

  /// Whether the film, of `paths` paths, has reached the error. It is computed when the predicted number of
  /// paths is done, else for at most 2% of the time.
  [[nodiscard]] bool reached(const film::Film& film, std::uint64_t paths);

  /// How many paths the render should have, as far as is known: the error falls with the square root of their
  /// number. At most twice the paths of the last computation, as an error of few samples is uncertain.
  [[nodiscard]] double wanted_paths() const { return wanted_paths_; }

private:
  double error_;
  double wanted_paths_;
  Clock::time_point next_check_{};
};

} // namespace phlux::render
