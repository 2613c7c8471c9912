// When a render's checkpoints are written, and what they hold.
#pragma once

#include <chrono>
#include <filesystem>
#include <future>
#include <optional>

#include "checkpoint/checkpoint.h"
#include "cli/options.h"
#include "errors.h"

namespace phlux::cli {

inline constexpr double default_checkpoint_seconds = 60.0;

/// The checkpoint that the render goes on from, and what the user chose then and does not choose now.
/// @throws FileError as checkpoint::read
[[nodiscard]] std::optional<checkpoint::Checkpoint> resumed(RenderOptions& options);

/// @throws FileError or UsageError as checkpoint::check_same
void check_same(const checkpoint::Checkpoint& earlier, const checkpoint::Session& now,
                const scene::Camera& camera, const std::filesystem::path& file);

/// Writes to one file, again and again. Without a name it does nothing.
class Checkpoints {
public:
  Checkpoints(std::filesystem::path file, const RenderOptions& options, checkpoint::Session session);

  /// Now and then, in a thread of its own: the render waits for a copy in memory alone. A checkpoint that
  /// cannot be written is a warning, as the next may succeed.
  void update(const film::Film& film, const render::Progress& progress);
  /// The last one. Why it could not be written, if so: what else there is to write comes before that.
  [[nodiscard]] std::optional<WriteError> finish(const film::Film& film, const render::RenderState& state);

private:
  using Clock = std::chrono::steady_clock;
  void wait();

  std::filesystem::path file_;
  checkpoint::Session session_;
  Clock::duration between_;
  Clock::time_point next_;
  std::future<void> writing_;
};

} // namespace phlux::cli
