// Images of textures and skies: as many finite values as pixels, or a SceneError.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "errors.h"
#include "input.h"
#include "scene_file/image_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  const Input input(bytes, count);
  try {
    const phlux::scene_file::ImageFile image =
        phlux::scene_file::read_image(input.file(), {std::make_shared<const std::string>("scene.xml"), 1});
    const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    const bool whole = image.bytes.empty() ? image.floats.size() == 3 * pixels
                                           : image.floats.empty() && image.bytes.size() == 4 * pixels;
    if (!whole || !std::ranges::all_of(image.floats, [](float value) { return std::isfinite(value); }))
      std::abort();
  } catch (const phlux::SceneError&) {
  }
  return 0;
}
