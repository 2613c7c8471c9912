#include "cli/checkpoints.h"

#include <new>
#include <ostream>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "checkpoint/sameness.h"
#include "files/output.h"

namespace phlux::cli {
namespace {

// Adds a remedy to the error of a checkpoint that does not match.
template<class Function>
auto with_remedy(const Function& function) {
  constexpr const char* anew = ", or leave out --resume to start anew";
  try {
    return function();
  } catch (const FileError& error) {
    throw FileError(error.what() + std::string(anew));
  } catch (const UsageError& error) {
    throw UsageError(error.what() + std::string(anew));
  }
}

// Whether a copy would take more memory than an interruption of the render is worth.
bool is_large(const film::Film& film) {
  constexpr double most_copied = 1 << 28; // bytes
  return film::Film::bytes(static_cast<double>(film.pixels().size()), 1, film.splats() ? 1 : 0,
                           film.dependent_samples() ? 1 : 0, 0) > most_copied;
}

// A checkpoint from elsewhere must not run code on this machine.
void require_own_strategy(const RenderOptions& options, const settings::Choices& earlier) {
  const auto then = earlier.texts.find("strategy");
  if (then == earlier.texts.end() || options.has("strategy") || !settings::is_strategy_file(then->second))
    return;
  throw UsageError(fmt::format(
      "--resume {}: its render had --strategy {}, and a checkpoint alone must not run your files: "
      "give --strategy {} too",
      options.resume.string(), then->second, then->second));
}

} // namespace

std::optional<checkpoint::Checkpoint> resumed(RenderOptions& options) {
  if (options.resume.empty()) return std::nullopt;
  checkpoint::Checkpoint earlier = with_remedy([&] { return checkpoint::read(options.resume); });
  require_own_strategy(options, earlier.session.choices);
  options.complete(earlier.session.choices);
  return earlier;
}

void check_same(const checkpoint::Checkpoint& earlier, const checkpoint::Session& now,
                const scene::Camera& camera, const std::filesystem::path& file) {
  with_remedy([&] { checkpoint::check_same(earlier, now, camera.width, camera.height, file); });
}

Checkpoints::Checkpoints(std::filesystem::path file, const RenderOptions& options,
                         checkpoint::Session session)
    : file_(std::move(file)), session_(std::move(session)),
      between_(std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(options.checkpoint_seconds.value_or(default_checkpoint_seconds)))),
      next_(Clock::now() + between_) {
  if (!file_.empty() && options.resume.empty() && std::filesystem::is_regular_file(file_))
    spdlog::warn("--checkpoint {}: replaces an earlier checkpoint, from which --resume would continue",
                 file_.string());
}

void Checkpoints::wait() {
  try {
    if (writing_.valid()) writing_.get();
  } catch (const WriteError& error) {
    spdlog::warn("{}: rendering continues, and the next checkpoint may succeed", error.what());
  }
}

void Checkpoints::update(const film::Film& film, const render::Progress& progress) {
  if (file_.empty() || Clock::now() < next_) return;
  if (writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  wait();
  session_.state = progress.state();
  try {
    if (is_large(film)) throw std::bad_alloc();
    writing_ = std::async(std::launch::async, [file = file_, bytes = checkpoint::encode(session_, film)] {
      files::write_file(file, bytes);
    });
  } catch (const std::bad_alloc&) {
    writing_ = std::async(std::launch::deferred, [&] { write(film); });
    wait();
  }
  next_ = Clock::now() + between_;
}

void Checkpoints::write(const film::Film& film) const {
  files::write_file(file_, [&](std::ostream& to) { checkpoint::write(session_, film, to); });
}

std::optional<WriteError> Checkpoints::finish(const film::Film& film, const render::RenderState& state) {
  if (file_.empty()) return std::nullopt;
  wait();
  session_.state = state;
  try {
    write(film);
  } catch (const WriteError& error) {
    return error;
  }
  return std::nullopt;
}

} // namespace phlux::cli
