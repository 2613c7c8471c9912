// Scene files: a scene, or a SceneError.
#include <spdlog/spdlog.h>

#include "errors.h"
#include "input.h"
#include "scene/digest.h"
#include "scene_file/load.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  spdlog::set_level(spdlog::level::off);
  const Input input(bytes, count);
  try {
    static_cast<void>(phlux::scene::digest(phlux::scene_file::load(input.file())));
  } catch (const phlux::SceneError&) {
  }
  return 0;
}
