// The scenes of scenes/stability, and how far an image of one is off. scenes/stability/README.md has the
// figures.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "images/integrators.h"

namespace phlux::test {

using Definitions = std::map<std::string, std::string>;

/// Images are compared by tiles of so many pixels' side.
inline constexpr int tile = 4;

[[nodiscard]] std::filesystem::path stability_folder();
/// 32 x 24 pixels, unless the definitions say otherwise.
[[nodiscard]] scene::Scene stability(const std::string& name, Definitions definitions = {});

/// `samples` samples a pixel by a method.
[[nodiscard]] render::Settings settings_with_seed(const Method& method, int samples, std::uint64_t seed);
[[nodiscard]] film::Film film_by(const Method& method, const scene::Scene& scene, int samples,
                                 std::uint64_t seed);
[[nodiscard]] Estimate image_by(const Method& method, const scene::Scene& scene, int samples,
                                std::uint64_t seed);

/// CHECKs whether the program would say that the film's error estimate can be believed, with its reasons if
/// not.
void check_verdict(const film::Film& film, bool trusted);
/// CHECKs that tiles differ by noise alone. Pixels of one path are not independent, and so nothing is said of
/// the image's mean.
void check_tiles(const Estimate& image, const Estimate& reference);

/// Root of the mean squared difference of tiles, relative to the root of their mean square.
[[nodiscard]] double relative_error(const Estimate& image, const Estimate& reference);
/// Over pixels and channels.
[[nodiscard]] double mean_of(const Estimate& image);

} // namespace phlux::test
