#include "images/stability.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "film/reliability.h"
#include "images/evidence.h"
#include "scene_file/load.h"

namespace phlux::test {

std::filesystem::path stability_folder() {
  return PHLUX_SOURCE_DIR "/scenes/stability";
}

scene::Scene stability(const std::string& name, Definitions definitions) {
  definitions.insert({{"width", "32"}, {"height", "24"}});
  return scene_file::load(stability_folder() / (name + ".xml"), definitions);
}

render::Settings settings_with_seed(const Method& method, int samples, std::uint64_t seed) {
  render::Settings result = settings_for(method, samples);
  result.seed = seed;
  return result;
}

film::Film film_by(const Method& method, const scene::Scene& scene, int samples, std::uint64_t seed) {
  Render render = render_of(scene, settings_with_seed(method, samples, seed));
  CHECK(render.statistics.nonfinite == 0);
  return std::move(render.film);
}

Estimate image_by(const Method& method, const scene::Scene& scene, int samples, std::uint64_t seed) {
  return estimate_of(film_by(method, scene, samples, seed));
}

void check_verdict(const film::Film& film, bool trusted) {
  const film::Reliability verdict = film::reliability_of(film);
  CAPTURE(verdict.reasons);
  CHECK(verdict.trusted == trusted);
  CHECK(verdict.reasons.empty() == verdict.trusted);
}

void check_tiles(const Estimate& image, const Estimate& reference) {
  check_agreement_of_pixels(tiles(image, tile), tiles(reference, tile));
}

double relative_error(const Estimate& image, const Estimate& reference) {
  const Estimate a = tiles(image, tile), b = tiles(reference, tile);
  double difference = 0, square = 0;
  for (std::size_t i = 0; i < a.mean.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      difference += std::pow(a.mean[i][c] - b.mean[i][c], 2);
      square += std::pow(b.mean[i][c], 2);
    }
  return std::sqrt(difference / square);
}

double mean_of(const Estimate& image) {
  double sum = 0;
  for (const Channels& mean : image.mean) sum += mean[0] + mean[1] + mean[2];
  return sum / (3.0 * static_cast<double>(image.mean.size()));
}

} // namespace phlux::test
