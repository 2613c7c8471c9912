#include "checkpoint/sameness.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>
#include <xxhash.h>

#include "errors.h"
#include "settings/strategies.h"

namespace phlux::checkpoint {
namespace {

using settings::Affects;

constexpr char strategy_follows = '+';

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

// The samples of each pixel, asked for in the order of the pixels.
class SamplesByPosition {
public:
  explicit SamplesByPosition(const render::SchedulePosition& position, std::int64_t pixels)
      : samples_(position.end()) {
    changes_[position.pixel] -= position.pixel > 0 ? position.block_samples : 0;
    for (const render::Launch& launch : position.missing) {
      samples_ -= launch.jobs / pixels * launch.block_samples;
      const std::int64_t first = launch.first_job, end = first + launch.jobs % pixels;
      add(first, std::min(end, pixels), -launch.block_samples);
      if (end > pixels) add(0, end - pixels, -launch.block_samples);
    }
  }
  std::int64_t of(std::int64_t pixel) {
    for (; !changes_.empty() && changes_.begin()->first <= pixel; changes_.erase(changes_.begin()))
      samples_ += changes_.begin()->second;
    return samples_;
  }

private:
  void add(std::int64_t first, std::int64_t end, std::int64_t samples) {
    changes_[first] += samples;
    changes_[end] -= samples;
  }
  std::map<std::int64_t, std::int64_t> changes_; // from a pixel on
  std::int64_t samples_;
};

bool is_sound(const render::Launch& launch, std::int64_t pixels, std::int64_t end) {
  return launch.first_job >= 0 && launch.first_job < pixels && launch.jobs >= 1 &&
         launch.jobs <= pixels * end && launch.block_samples >= 1 &&
         launch.block_samples <= render::most_block_samples && launch.first_sample >= 0 &&
         launch.first_sample + ((launch.first_job + launch.jobs - 1) / pixels + 1) * launch.block_samples <=
             end;
}

// Empty if the schedule is one that a render of this size can have had.
std::string contradiction(const render::RenderState& state, std::int64_t pixels, std::int64_t most_samples) {
  const render::SchedulePosition& position = state.position;
  if (position.sample < 0 || position.sample > most_samples || position.pixel < 0 ||
      position.pixel >= pixels || position.block_samples < 1 ||
      position.block_samples > render::most_block_samples || position.end() > most_samples)
    return "its position";
  for (const render::Launch& launch : position.missing)
    if (!is_sound(launch, pixels, position.end())) return "its missing samples";
  if (const auto& origin = state.first_nonfinite)
    if (origin->pixel < 0 || origin->pixel >= pixels || origin->sample < 0 || origin->sample > most_samples ||
        origin->samples < 1 || origin->samples > render::most_block_samples)
      return "its first contribution that was not finite";
  if (!(state.seconds_render >= 0.0) || !std::isfinite(state.seconds_render)) return "its seconds";
  return {};
}

// A file whose digest matches may still be forged: every number that leads to an index, a length or a loop is
// checked against the render that it is for.
void check_state(const Checkpoint& earlier, const render::Settings& now, const std::string& file) {
  const render::RenderState& state = earlier.session.state;
  const film::Film& film = earlier.film;
  const auto pixels = std::int64_t{film.width()} * film.height();
  std::string wrong = contradiction(state, pixels, settings::most_samples - now.first_sample);
  if (wrong.empty()) {
    const settings::IntegratorInfo& integrator = settings::integrator_named(now.integrator);
    const bool splats = film.splats(); // none before the first launch, and if nothing in the scene shines
    SamplesByPosition expected(state.position, pixels);
    std::uint64_t paths = 0;
    const auto samples_of = [&](std::size_t pixel) -> std::uint64_t {
      const std::int64_t samples = expected.of(static_cast<std::int64_t>(pixel));
      paths += static_cast<std::uint64_t>(samples);
      return integrator.eye_paths || !splats ? static_cast<std::uint64_t>(samples) : 0;
    };
    wrong = film.contradiction(samples_of, splats ? state.paths : 0);
    if (wrong.empty() && paths != state.paths) wrong = "numbers of paths";
    if (film.clamps() && !now.clamp) wrong = "clamping";
    if (splats && !integrator.light_paths) wrong = "splats";
    if (film.dependent_samples() != settings::samples_point_sets(now)) wrong = "point sets";
  }
  if (!wrong.empty())
    throw FileError(fmt::format(
        "{}: is damaged: {} cannot be of this render: resume from an earlier checkpoint", file, wrong));
}

} // namespace

std::string digest_with_strategy(const std::string& scene_digest, const render::Settings& settings) {
  if (!settings::is_strategy_file(settings.strategy)) return scene_digest;
  const std::string text = settings::read_strategy(settings.strategy);
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{}{}{:016x}{:016x}", scene_digest, strategy_follows, hash.high64, hash.low64);
}

std::string scene_part(const std::string& digest) {
  return digest.substr(0, digest.find(strategy_follows));
}

void check_same(const Checkpoint& earlier, const Session& now, int width, int height,
                const std::filesystem::path& file) {
  const film::Film& film = earlier.film;
  if (earlier.session.settings.crop != now.settings.crop)
    check_settings(earlier.session.settings, now.settings, file.string());
  if (film.width() != width || film.height() != height)
    throw FileError(fmt::format("{}: is of {}x{} pixels, not {}x{}: give `size` {}x{}", file.string(),
                                film.width(), film.height(), width, height, film.width(), film.height()));
  if (scene_part(earlier.session.scene_digest) != scene_part(now.scene_digest))
    throw FileError(
        fmt::format("{}: is of another scene: give {} as it was when the checkpoint was written, with "
                    "the same definitions",
                    file.string(), earlier.session.scene));
  check_settings(earlier.session.settings, now.settings, file.string());
  if (earlier.session.scene_digest != now.scene_digest)
    throw FileError(
        fmt::format("{}: is of a render with another {}: give it as it was when the checkpoint was "
                    "written",
                    file.string(), now.settings.strategy));
  check_state(earlier, now.settings, file.string());
  check_amount(earlier.session.state.position, now.settings, file.string());
}

} // namespace phlux::checkpoint
