#include "checkpoint/sameness.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "errors.h"
#include "render/names.h"

namespace phlux::checkpoint {
namespace {

struct Option {
  const char* name;
  std::string value; // empty: left out
};

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

// The options that would lead to these settings of the image.
std::vector<Option> options_of(const render::Settings& settings) {
  return {{"--integrator", settings.integrator},
          {"--strategy", settings.strategy},
          {"--connect", render::name_of(settings.connect)},
          {"--weights", render::name_of(settings.weights)},
          {"--light-selection", render::name_of(settings.light_selection)},
          {"--connections", std::to_string(settings.connections)},
          {"--contributions", settings.techniques ? "DIR" : ""},
          {"--ambient", text_of(settings.ambient)},
          {"--clamp", text_of(settings.clamp)},
          {"--max-depth", std::to_string(settings.max_depth)},
          {"--rr-depth", std::to_string(settings.rr_depth)},
          {"--seed", std::to_string(settings.seed)},
          {"--first-sample", std::to_string(settings.first_sample)},
          {"--precision", settings.double_precision ? "double" : "single"}};
}

std::string given(const Option& option) {
  return option.value.empty() ? fmt::format("without {}", option.name)
                              : fmt::format("with {} {}", option.name, option.value);
}

void check_settings(const render::Settings& earlier, const render::Settings& now, const std::string& file) {
  const std::vector<Option> were = options_of(earlier), are = options_of(now);
  for (std::size_t i = 0; i < were.size(); ++i)
    if (were[i].value != are[i].value)
      throw SceneError(fmt::format("{}: is of a render {}, not {}: {}, or leave out --resume to begin anew",
                                   file, given(were[i]), given(are[i]),
                                   were[i].value.empty()
                                       ? fmt::format("leave out {}", were[i].name)
                                       : fmt::format("give {} {}", were[i].name, were[i].value)));
}

void check_amount(const render::Place& place, const render::Settings& now, const std::string& file) {
  if (now.time_limit || now.target_error || place.end() <= now.samples_per_pixel) return;
  throw UsageError(fmt::format("{}: has {} samples per pixel already, and --spp {} asks for fewer: give "
                               "--spp {} or more, or leave out --resume to begin anew",
                               file, place.end(), now.samples_per_pixel, place.end()));
}

} // namespace

void check_same(const Checkpoint& earlier, const Session& now, int width, int height,
                const std::filesystem::path& file) {
  const film::Film& film = earlier.film;
  if (film.width() != width || film.height() != height)
    throw SceneError(fmt::format("{}: is of {}x{} pixels, not {}x{}: give --size {}x{}, or leave out "
                                 "--resume to begin anew",
                                 file.string(), film.width(), film.height(), width, height, film.width(),
                                 film.height()));
  if (earlier.session.scene_digest != now.scene_digest)
    throw SceneError(fmt::format("{}: is of another scene, {} as it was then: give that, with the -D it had, "
                                 "or leave out --resume to begin anew",
                                 file.string(), earlier.session.scene));
  check_settings(earlier.session.settings, now.settings, file.string());
  check_amount(earlier.session.standing.place, now.settings, file.string());
}

} // namespace phlux::checkpoint
