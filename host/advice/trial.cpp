#include "advice/trial.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "errors.h"

namespace phlux::advice {
namespace {

// The difference of two means that their noise does not explain, in standard errors: among the 16 tiles of
// three trials one in 300 comparisons of images exceeds it by chance if errors are normal.
constexpr double significant_sigmas = 4.0;

std::vector<TileEstimate> tiles_of(const film::Film& film) {
  const film::TileMeans& tiles = film.evidence().tiles();
  std::vector<TileEstimate> result(tiles.count());
  for (std::size_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    TileEstimate& tile = result[tiles.tile_of(pixel)];
    const std::array<double, 3> mean = film.mean(pixel), variance = film.variance_of_mean(pixel);
    const double error = std::sqrt(variance[0]) + std::sqrt(variance[1]) + std::sqrt(variance[2]);
    tile.radiance += mean[0] + mean[1] + mean[2];
    tile.variance += error * error; // an upper bound: channels are correlated
    tile.pixels += 1.0;
  }
  return result;
}

} // namespace

std::string method_of(const render::Settings& of) {
  std::string text = "`integrator` " + of.integrator;
  for (const settings::Setting& setting : settings::all())
    if (!setting.conditions.empty() && setting.value(of) != setting.value({}))
      text += fmt::format(" {} {}", settings::quoted(setting.name), setting.text(of));
  return text;
}

Trial try_method(const scene::Scene& scene, const render::Settings& settings, tables::KnownGeometry& known,
                 const render::Events& events) {
  Trial trial;
  trial.method = method_of(settings);
  try {
    film::Film film(scene.camera.width, scene.camera.height);
    trial.statistics = render::render(scene, settings, film, events, {}, {}, &known);
    trial.relative_standard_error = film.relative_standard_error();
    trial.reliability = film::reliability_of(film);
    trial.tiles = tiles_of(film);
    const double error = trial.reliability.relative_standard_error;
    trial.cost = error * error * trial.statistics.seconds_render;
  } catch (const UsageError& error) {
    trial.refusal = error.what();
  }
  return trial;
}

bool is_comparable(const Trial& trial) {
  return trial.cost > 0.0 && trial.reliability.coverage >= comparable_coverage &&
         trial.reliability.variance_error <= film::largest_variance_error;
}

double missing_error(const Trial& trial, std::span<const Trial> others) {
  double pixels = 0.0, errors = 0.0;
  for (std::size_t i = 0; i < trial.tiles.size(); ++i) {
    const TileEstimate& tile = trial.tiles[i];
    double missing = 0.0; // relative to the other trial's radiance
    for (const Trial& other : others) {
      if (other.tiles.empty()) continue; // it was refused
      const TileEstimate& theirs = other.tiles[i];
      const double difference = theirs.radiance - tile.radiance;
      if (difference > significant_sigmas * std::sqrt(tile.variance + theirs.variance))
        missing = std::max(missing, difference / theirs.radiance);
    }
    pixels += tile.pixels;
    errors += tile.pixels * missing * missing * tile.pixels; // a pixel has fewer samples than its tile
  }
  return pixels > 0.0 ? std::sqrt(errors / pixels) : 0.0;
}

render::Settings trial_settings(render::Settings settings) {
  settings.time_limit.reset();
  settings.target_error.reset();
  settings.clamp.reset();
  settings.techniques = false;
  return settings;
}

} // namespace phlux::advice
