// Reads and writes the checkpoints of a render.
#pragma once

#include <filesystem>
#include <future>
#include <optional>

#include "checkpoint/checkpoint.h"
#include "cli/options.h"
#include "clock.h"

namespace phlux::cli {

inline constexpr double default_checkpoint_seconds = 60.0;

/// The checkpoint to resume from, if any; its choices are added to `options` where those are not given.
/// @throws FileError as checkpoint::read, UsageError for a strategy file that is not given again
[[nodiscard]] std::optional<checkpoint::Checkpoint> resumed(RenderOptions& options);

/// @throws FileError or UsageError as checkpoint::check_same
void check_same(const checkpoint::Checkpoint& earlier, const checkpoint::Session& now,
                const scene::Camera& camera, const std::filesystem::path& file);

/// Writes checkpoints to one file, each replacing the last. Does nothing without a file name.
class Checkpoints {
public:
  /// @throws UsageError if the file is something else than a checkpoint, which would be lost
  Checkpoints(std::filesystem::path file, const RenderOptions& options, checkpoint::Session session);

  /// Writes a checkpoint when the interval has passed, in another thread; the render waits only for the copy
  /// in memory, or, if that would be large, for the file. A failure is a warning, as the next may succeed.
  void update(const film::Film& film, const render::Progress& progress);
  /// Writes the last checkpoint. @throws WriteError
  void finish(const film::Film& film, const render::RenderState& state, const film::Progress& progress);

private:
  void wait();
  void write(const film::Film& film, const film::Progress& progress = {}) const;

  std::filesystem::path file_;
  checkpoint::Session session_;
  Clock::duration between_;
  Clock::time_point next_;
  std::future<void> writing_;
};

} // namespace phlux::cli
