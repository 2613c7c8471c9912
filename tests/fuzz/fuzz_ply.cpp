// PLY files: a mesh whose indices are in range and whose numbers are finite, or a SceneError.
#include "mesh_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  fuzz_mesh(phlux::scene_file::load_ply, bytes, count);
  return 0;
}
