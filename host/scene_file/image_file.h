// Reads image files for textures and environment maps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene_file/location.h"

namespace phlux::scene_file {

/// Pixels row by row from the top, in one of the two lists.
struct ImageFile {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes; ///< R, G, B, 255 per pixel, of files with at most 8 bits a channel
  std::vector<float> floats;       ///< R, G, B per pixel, finite
  bool is_encoded = false;         ///< values are sRGB-encoded, from 0 to 1 (255); otherwise linear
};

/// What the three channels of a pixel are read from: their colours or, all three, the alpha, which is linear.
enum class ImageChannels { colors, alpha };

/// Most pixels of an image: 16384 x 16384.
inline constexpr std::uint64_t most_image_pixels = std::uint64_t{1} << 28;

/// Reads PNG, JPEG, BMP and TGA (8 or 16 bits a channel), HDR (RGBE) and OpenEXR (channels R, G, B or Y).
/// Grey becomes three equal channels. The size that the file claims is checked before
/// memory is allocated.
/// @throws SceneError at `named_at` if the file cannot be read, is damaged, cut short, too large, of another
/// format, without the channels, or has a pixel that is not finite
[[nodiscard]] ImageFile read_image(const std::filesystem::path& file, const Location& named_at,
                                   ImageChannels channels = ImageChannels::colors);

/// @throws SceneError at `named_at`, with the name of the image
[[noreturn]] void fail_in_image(const std::filesystem::path& file, const Location& named_at,
                                const std::string& wrong, const std::string& right);

} // namespace phlux::scene_file
