// The image that errors are measured against.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "bench/common/methods/image_estimates.h"
#include "bench/common/methods/method.h"

namespace phlux::bench {

struct ReferenceImage {
  Reference radiance;
  double relmse = 0; ///< expected, of its own noise
  Figure mean;       ///< of the image, over `repeats` renders
  int repeats = 0;
  std::string method; ///< that made it
  double seconds = 0, samples_per_pixel = 0;
};

/// Renders it with `method` in `seconds`, from seeds of its own. @throws Interrupted, and as render()
[[nodiscard]] ReferenceImage make_reference(const scene::Scene& scene, const Method& method,
                                            render::Settings settings, double seconds,
                                            const std::function<bool()>& interrupted);

/// `file` (EXR, with a .json beside it) made with these settings; nothing where there is none, or one of
/// others. @throws FileError for files that are damaged, saying to delete them
[[nodiscard]] std::optional<ReferenceImage> read_reference(const std::filesystem::path& file,
                                                           const std::string& settings);

/// @throws WriteError
void write_reference(const std::filesystem::path& file, const std::string& settings,
                     const ReferenceImage& reference, const scene::Camera& camera);

} // namespace phlux::bench
