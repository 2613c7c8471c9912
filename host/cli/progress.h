// What the user sees while a render runs: one line that changes on a terminal, a plain line now and then
// elsewhere.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "render/render.h"

namespace phlux::cli {

/// The part of the render that is done, in [0, 1]; 0 while unknown. The error falls with the root of the
/// samples, so (target / error)^2 of the work for a target error is done.
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
  /// To be called often; asks for `error`, the relative standard error so far, only when it shows it.
  void update(const render::Progress& progress, const std::function<double()>& error);
  /// Takes the changing line away, for whatever comes next.
  void clear();

private:
  void show(const std::string& text);

  bool quiet_, terminal_;
  std::optional<double> time_limit_, target_error_;
  double next_update_; // seconds of rendering
  bool line_is_shown_ = false;
};

} // namespace phlux::cli
