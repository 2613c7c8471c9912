// Where a render's files go.
#pragma once

#include <filesystem>

#include "cli/options.h"
#include "files/image.h"

namespace phlux::cli {

/// Empty where nothing is written.
struct Outputs {
  std::filesystem::path image, preview, statistics, checkpoint;
};

/// The options' files or their defaults; a resumed render writes its checkpoints where it was resumed from.
/// No preview goes beside what is not a regular file (/dev/null).
/// @throws UsageError for one name given twice, or an image named as another format
[[nodiscard]] Outputs outputs_of(const RenderOptions& options);

/// @throws WriteError for the first that could not be written
void check_writable(const Outputs& outputs);

/// Rewrites the preview while the render goes on, every three seconds or less often: at most 2% of the time
/// is spent on it. A preview that cannot be written is left to the end to complain about.
class PreviewRefresher {
public:
  explicit PreviewRefresher(std::filesystem::path file) : file_(std::move(file)) {}
  /// `seconds` of rendering so far.
  void update(const film::Film& film, double seconds);

private:
  std::filesystem::path file_;
  double next_ = seconds_between;
  static constexpr double seconds_between = 3.0;
};

} // namespace phlux::cli
