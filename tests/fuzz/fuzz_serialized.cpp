// Mitsuba's serialized meshes: indices in range and finite numbers, or a SceneError.
#include "mesh_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  fuzz_mesh(phlux::scene_file::load_serialized, bytes, count);
  return 0;
}
