// The shapes of a random scene: surroundings of the camera, objects, and emitting objects.
#pragma once

#include <string>

#include "random/random_lights.h"
#include "random/random_materials.h"
#include "random/random_mesh.h"
#include "random/scene_draft.h"

namespace phlux::test {

enum class Walls { none, floor, rectangles, mesh, sphere };

class RandomShapes {
public:
  RandomShapes(SceneDraft& draft, Walls walls, RandomMaterials& materials, RandomLights& lights);
  /// Writes all shapes.
  void write();

private:
  void walls();
  void wall(const scene::Vec3& center, double half);
  void object(bool lamp, int index);
  void instance(const std::string& type, int group, bool elsewhere);
  void open(const std::string& type);
  void ball(double size);
  void steps_to_place(const std::string& type, double size);
  void mesh(const std::string& type, int index);
  void mesh_file(const std::string& name, const RandomMesh& mesh);

  SceneDraft& draft_;
  Walls kind_of_walls_;
  double reach_; ///< objects' coordinates are up to this
  RandomMaterials& materials_;
  RandomLights& lights_;
};

} // namespace phlux::test
