#include "cli/checkpoints.h"

#include <functional>
#include <ostream>
#include <system_error>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "checkpoint/sameness.h"
#include "cli/memory.h"
#include "errors.h"
#include "files/output.h"

namespace phlux::cli {
namespace {

// Bytes of a film whose copy would take more memory than an interruption of the render is worth.
constexpr double most_copied = 1 << 28;

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

// A checkpoint from elsewhere must not run code on this machine.
void require_own_strategy(const RenderOptions& options, const settings::Choices& earlier) {
  const auto then = earlier.texts.find("strategy");
  if (then == earlier.texts.end() || options.has("strategy") || !settings::is_strategy_file(then->second))
    return;
  throw UsageError(
      fmt::format("--resume {}: its render used --strategy {}, and a checkpoint cannot choose a kernel file: "
                  "give --strategy {} too",
                  options.resume.string(), then->second, then->second));
}

void replace(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  if (!checkpoint::is_replaceable(file)) // any longer
    throw WriteError(
        fmt::format("{}: is not a checkpoint and is not overwritten: name another file", file.string()));
  files::write_file(file, write);
}

// Rendering continues where memory, threads or disks do not suffice for a checkpoint.
template<class Step>
void warn_if_it_fails(const std::filesystem::path& file, const Step& step) {
  constexpr const char* consequence = "rendering continues, and the next checkpoint may succeed";
  try {
    step();
  } catch (const WriteError& error) {
    spdlog::warn("{}: {}", error.what(), consequence);
  } catch (const std::exception& error) {
    spdlog::warn("{}: no checkpoint: {}: {}", file.string(), error.what(), consequence);
  }
}

} // namespace

std::optional<checkpoint::Checkpoint> resumed(RenderOptions& options) {
  if (options.resume.empty()) return std::nullopt;
  checkpoint::Checkpoint earlier = with_remedy(
      [&] { return checkpoint::read(options.resume, storage_for(options.resume, options.memory)); });
  require_own_strategy(options, earlier.session.choices);
  options.complete(earlier.session.choices);
  return earlier;
}

void check_same(const checkpoint::Checkpoint& earlier, const checkpoint::Session& now,
                const scene::Camera& camera, const std::filesystem::path& file) {
  with_remedy([&] { checkpoint::check_same(earlier, now, camera.width, camera.height, file); });
  const double seconds = earlier.session.state.seconds_render;
  if (now.settings.time_limit && seconds >= *now.settings.time_limit)
    spdlog::warn("--time {:g}: the render in {} has taken {:.3g} s already: no samples are added",
                 *now.settings.time_limit, file.string(), seconds);
}

Checkpoints::Checkpoints(std::filesystem::path file, const RenderOptions& options,
                         checkpoint::Session session)
    : file_(std::move(file)), session_(std::move(session)),
      between_(duration_of(options.checkpoint_seconds.value_or(default_checkpoint_seconds))),
      next_(Clock::now() + between_) {
  if (file_.empty()) return;
  if (!checkpoint::is_replaceable(file_))
    throw UsageError(fmt::format("--checkpoint {}: is not a checkpoint of phlux and would be overwritten: "
                                 "name another file, or delete it",
                                 file_.string()));
  std::error_code none;
  if (options.resume.empty() && std::filesystem::is_regular_file(file_, none) &&
      !std::filesystem::is_empty(file_, none))
    spdlog::warn("--checkpoint {}: replaces an earlier checkpoint, from which --resume would continue",
                 file_.string());
}

void Checkpoints::wait() {
  if (writing_.valid()) writing_.get();
}

void Checkpoints::update(const film::Film& film, const render::Progress& progress) {
  if (file_.empty() || Clock::now() < next_) return;
  if (writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  warn_if_it_fails(file_, [&] { wait(); });
  warn_if_it_fails(file_, [&] {
    session_.state = progress.state();
    if (film.bytes() > most_copied) return write(film);
    try {
      writing_ = std::async(std::launch::async, [file = file_, bytes = checkpoint::encode(session_, film)] {
        replace(file, [&](std::ostream& to) { to << bytes; });
      });
    } catch (const std::system_error&) { // no thread
      write(film);
    }
  });
  next_ = Clock::now() + between_;
}

void Checkpoints::write(const film::Film& film, const film::Progress& progress) const {
  replace(file_, [&](std::ostream& to) { checkpoint::write(session_, film, to, progress); });
}

void Checkpoints::finish(const film::Film& film, const render::RenderState& state,
                         const film::Progress& progress) {
  if (file_.empty()) return;
  warn_if_it_fails(file_, [&] { wait(); });
  session_.state = state;
  write(film, progress);
}

} // namespace phlux::cli
