// The mesh files of a scene, which are read after everything else, each once.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene_file/mesh.h"

namespace phlux::scene_file {

class Problems;

/// A shape whose geometry is in a file.
struct MeshShape {
  MeshRequest request;
  scene::Surface surface;
  std::map<std::string, int> materials; ///< obj: of the parts with these names of material, by their index
  bool library_materials = false;       ///< obj: parts without a material take that of the file's .mtl
};

class MeshFiles {
public:
  void add(MeshShape shape) { shapes_.push_back(std::move(shape)); }
  /// Adds the meshes of all shapes to the scene; errors become problems.
  void load(scene::Scene& scene, Problems& problems);

private:
  std::vector<MeshShape> shapes_;
};

} // namespace phlux::scene_file
