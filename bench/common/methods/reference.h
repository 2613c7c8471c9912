// Reference images.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "bench/common/methods/image_estimates.h"
#include "bench/common/methods/method.h"
#include "bench/common/methods/timed_render.h"

namespace phlux::bench {

struct ReferenceImage {
  Reference image; ///< with the variance from `repeats` renders
  Estimate mean;   ///< of the image
  int repeats = 0;
  std::string method; ///< that rendered it
  double seconds = 0, samples_per_pixel = 0;
};

/// Renders a reference for `seconds` in several repeats, with seeds from `seed` + 2,000,000 on. `renderer` is
/// that of `method`. @throws Interrupted, and as render()
[[nodiscard]] ReferenceImage make_reference(MethodRenderer& renderer, const Method& method,
                                            const scene::Camera& camera, std::uint64_t seed, double seconds,
                                            const std::function<bool()>& interrupted);

/// Reads `file` (EXR with variance channels, and a .json file beside it) if it exists and was made with these
/// settings.
/// @throws FileError if a file is damaged
[[nodiscard]] std::optional<ReferenceImage> read_reference(const std::filesystem::path& file,
                                                           const std::string& settings);

/// Writes what read_reference() reads. @throws WriteError
void write_reference(const std::filesystem::path& file, const std::string& settings,
                     const ReferenceImage& reference, const scene::Camera& camera);

/// The reference in `file` if it was made with these settings; else make(), which is written there. Creates
/// the folder. @throws as read_reference(), write_reference() and make()
[[nodiscard]] ReferenceImage saved_reference(const std::filesystem::path& file, const std::string& settings,
                                             const scene::Camera& camera,
                                             const std::function<ReferenceImage()>& make);

} // namespace phlux::bench
