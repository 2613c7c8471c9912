// The scenes of scenes/stability and the errors of their images, which scenes/stability/README.md lists.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "images/integrators.h"

namespace phlux::test {

using Definitions = std::map<std::string, std::string>;

/// Side in pixels of the tiles in which images are compared.
inline constexpr int tile = 4;

[[nodiscard]] std::filesystem::path stability_folder();
/// The scene with 32 x 24 pixels, unless the definitions say otherwise.
[[nodiscard]] scene::Scene stability(const std::string& name, Definitions definitions = {});

/// Settings with `samples` samples per pixel for a method.
[[nodiscard]] render::Settings settings_with_seed(const Method& method, int samples, std::uint64_t seed);
[[nodiscard]] film::Film film_by(const Method& method, const scene::Scene& scene, int samples,
                                 std::uint64_t seed);
[[nodiscard]] Estimate image_by(const Method& method, const scene::Scene& scene, int samples,
                                std::uint64_t seed);

/// CHECKs whether the error estimate of the film counts as trusted; prints the reasons if not.
void check_verdict(const film::Film& film, bool trusted);
/// CHECKs that tiles differ only by noise. The mean of the image is not tested, since pixels with a common
/// path are not independent.
void check_tiles(const Estimate& image, const Estimate& reference);

/// Root mean square difference of tiles, relative to their root mean square.
[[nodiscard]] double relative_error(const Estimate& image, const Estimate& reference);
/// Mean over pixels and channels.
[[nodiscard]] double mean_of(const Estimate& image);

} // namespace phlux::test
