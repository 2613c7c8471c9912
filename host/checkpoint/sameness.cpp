#include "checkpoint/sameness.h"

#include <string>

#include <fmt/format.h>

#include "errors.h"

namespace phlux::checkpoint {
namespace {

using settings::Affects;

bool decides_image(Affects affects) {
  return affects != Affects::amount && affects != Affects::execution;
}

void check_settings(const render::Settings& earlier, const render::Settings& now, const std::string& file) {
  for (const settings::Setting& setting : settings::all()) {
    if (!decides_image(setting.affects) || setting.value(earlier) == setting.value(now)) continue;
    const std::string name = settings::quoted(setting.name), was = setting.text(earlier),
                      is = setting.text(now);
    const auto given = [&](const std::string& text) {
      return text.empty() ? "without " + name : fmt::format("with {} {}", name, text);
    };
    throw FileError(fmt::format("{}: is of a render {}, not {}: {}", file, given(was), given(is),
                                was.empty() ? "leave out " + name : fmt::format("give {} {}", name, was)));
  }
}

void check_amount(const render::SchedulePosition& position, const render::Settings& now,
                  const std::string& file) {
  if (now.time_limit || now.target_error || position.end() <= now.samples_per_pixel) return;
  throw UsageError(
      fmt::format("{}: has {} samples per pixel already, and `spp` {} asks for fewer: give `spp` {} or more",
                  file, position.end(), now.samples_per_pixel, position.end()));
}

} // namespace

void check_same(const Checkpoint& earlier, const Session& now, int width, int height,
                const std::filesystem::path& file) {
  const film::Film& film = earlier.film;
  if (film.width() != width || film.height() != height)
    throw FileError(fmt::format("{}: is of {}x{} pixels, not {}x{}: give `size` {}x{}", file.string(),
                                film.width(), film.height(), width, height, film.width(), film.height()));
  if (earlier.session.scene_digest != now.scene_digest)
    throw FileError(fmt::format("{}: is of another scene, {} as it was then: give that, with the definitions "
                                "it had",
                                file.string(), earlier.session.scene));
  check_settings(earlier.session.settings, now.settings, file.string());
  check_amount(earlier.session.state.position, now.settings, file.string());
}

} // namespace phlux::checkpoint
