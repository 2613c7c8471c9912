#include "bench/scenes/scene_files.h"

#include <algorithm>

#include "errors.h"
#include "scene/image_size.h"
#include "scene_file/load.h"

namespace phlux::bench {

scene::Scene load_at_size(const std::filesystem::path& file, int largest_side) {
  scene::Scene scene = scene_file::load(file);
  scene::shrink_image(scene.camera, largest_side);
  return scene;
}

std::vector<std::filesystem::path> shipped_scenes() {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  for (const std::filesystem::path& folder :
       {std::filesystem::path("scenes"), program.parent_path().parent_path() / "scenes"}) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
      if (entry.path().extension() == ".xml") files.push_back(entry.path());
    std::ranges::sort(files);
    if (!files.empty()) return files;
  }
  throw UsageError("scenes/: not found: run Phlux in its own folder or name the scene files");
}

void check_scenes(const std::vector<std::filesystem::path>& files) {
  for (const auto& file : files) (void)scene_file::load(file);
}

} // namespace phlux::bench
