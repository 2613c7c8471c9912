// Reference images.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "bench/common/methods/image_estimates.h"
#include "bench/common/methods/method.h"

namespace phlux::bench {

struct ReferenceImage {
  Reference radiance;
  double relmse = 0; ///< expected, from its own noise
  Estimate mean;     ///< of the image; from `repeats` renders
  int repeats = 0;
  std::string method; ///< that rendered it
  double seconds = 0, samples_per_pixel = 0;
};

/// Renders a reference by `method` for `seconds`, with seeds from settings.seed + 2,000,000 on.
/// @throws Interrupted, and as render()
[[nodiscard]] ReferenceImage make_reference(const scene::Scene& scene, const Method& method,
                                            render::Settings settings, double seconds,
                                            const std::function<bool()>& interrupted);

/// Reads `file` (EXR, with a .json file beside it) if it exists and was made with these settings.
/// @throws FileError if a file is damaged
[[nodiscard]] std::optional<ReferenceImage> read_reference(const std::filesystem::path& file,
                                                           const std::string& settings);

/// Writes what read_reference() reads. @throws WriteError
void write_reference(const std::filesystem::path& file, const std::string& settings,
                     const ReferenceImage& reference, const scene::Camera& camera);

} // namespace phlux::bench
