// Progress of a render: one changing line on a terminal, elsewhere a new line every ten seconds.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "clock.h"
#include "render/render.h"

namespace phlux::cli {

/// The fraction of the render that is done, in [0, 1]; 0 while unknown. For a target error it is
/// (target / error)^2, as the error falls with the square root of the samples.
[[nodiscard]] double fraction_done(const render::Progress& progress, std::optional<double> time_limit,
                                   std::optional<double> target_error, double error);

/// "45%  115/256 samples  5.2 M paths/s  error 2.3%  0:12 left"
[[nodiscard]] std::string progress_text(const render::Progress& progress, double fraction, double error);

class ProgressDisplay {
public:
  /// Shows nothing when `quiet`; writes to standard error.
  ProgressDisplay(bool quiet, std::optional<double> time_limit, std::optional<double> target_error);
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void building_kernels();
  /// To be called often; computes `error`, the relative standard error so far, only when it shows it.
  void update(const render::Progress& progress, const std::function<double()>& error);
  /// The same for a step after the render, of which the share `done` is done.
  void step(const std::string& what, double done);
  /// Erases the changing line.
  void clear();

private:
  void show(const std::string& text);
  [[nodiscard]] double between_updates() const; // in seconds

  bool quiet_, terminal_;
  std::optional<double> time_limit_, target_error_;
  double next_update_; // seconds of rendering
  Clock::time_point next_step_;
  bool line_is_shown_ = false;
};

} // namespace phlux::cli
