#include "cli/statistics.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <variant>

namespace phlux::cli {
namespace {

template<class T>
nlohmann::ordered_json value_or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nullptr;
}

nlohmann::ordered_json reliability_json(const std::optional<film::Reliability>& reliability,
                                        const film::Film& film, const render::Settings& settings) {
  if (!reliability) return nullptr;
  const film::Reliability& r = *reliability;
  const auto [x, y] = place_of(std::int64_t{r.worst_y} * film.width() + r.worst_x, film, settings);
  auto history = nlohmann::ordered_json::array();
  for (const film::Growth& then : film.evidence().history())
    history.push_back({{"samples", then.samples}, {"largest", then.largest}});
  return {{"trusted", r.trusted},
          {"reasons", r.reasons},
          {"coverage", r.coverage},
          {"relative_standard_error", r.relative_standard_error},
          {"variance", r.variance},
          {"variance_error", r.variance_error},
          {"top_share", r.top_share},
          {"tail_index", value_or_null(r.tail_index)},
          {"growth", value_or_null(r.growth)},
          {"worst", {{"x", x}, {"y", y}, {"share", r.worst_share}}},
          {"history", history}};
}

nlohmann::ordered_json origin_json(const std::optional<render::Origin>& origin, const film::Film& film,
                                   const render::Settings& settings) {
  if (!origin) return nullptr;
  const auto [x, y] = place_of(origin->pixel, film, settings);
  return {{"x", x}, {"y", y}, {"sample", origin->sample}, {"samples", origin->samples}};
}

nlohmann::ordered_json json_of(const settings::Value& value) {
  return std::visit(
      [](const auto& of) -> nlohmann::ordered_json {
        if constexpr (std::is_same_v<std::decay_t<decltype(of)>, std::monostate>)
          return nullptr;
        else
          return of;
      },
      value);
}

void add_settings(const render::Settings& settings, nlohmann::ordered_json& json) {
  for (const settings::Setting& setting : settings::all()) {
    if (!files::is_stored(setting) && setting.affects != settings::Affects::samples) continue;
    std::string key = setting.name;
    std::ranges::replace(key, '-', '_');
    json[key] = json_of(setting.value(settings));
  }
}

} // namespace

nlohmann::ordered_json statistics_json(const render::Statistics& statistics, const render::Settings& settings,
                                       const files::RenderInfo& info, const film::Film& film,
                                       const Diagnosis& diagnosis) {
  const film::Film::RelativeError& error = diagnosis.error;
  nlohmann::ordered_json json = {{"version", info.version}, {"scene", info.scene}};
  add_settings(settings, json);
  json["choice"] =
      info.choice.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(info.choice);
  json.update(
      {{"device", statistics.device},
       {"driver", statistics.driver},
       {"lanes", statistics.lanes},
       {"portable_lanes", statistics.portable_lanes},
       {"traversal", statistics.traversal},
       {"parts", statistics.parts},
       {"width", film.width()},
       {"height", film.height()},
       {"samples_per_pixel", film.samples_per_pixel()},
       {"paths", statistics.paths},
       {"rays", statistics.rays},
       {"shadow_rays", statistics.shadow_rays},
       {"nonfinite", statistics.nonfinite},
       {"seconds",
        {{"setup", statistics.seconds_setup},
         {"build_kernels", statistics.seconds_build_kernels},
         {"render", statistics.seconds_render}}},
       {"kernel_cache", statistics.kernels_from_cache ? "hit" : "miss"},
       {"variance", std::isfinite(error.standard_error) ? nlohmann::ordered_json(error.variance) : nullptr},
       {"relative_standard_error", error.standard_error},
       {"reliability", reliability_json(diagnosis.reliability, film, settings)},
       {"first_nonfinite", origin_json(statistics.first_nonfinite, film, settings)},
       {"clamped_share", info.clamped_share},
       {"advice", diagnosis.advice},
       {"interrupted", statistics.interrupted}});
  return json;
}

} // namespace phlux::cli
