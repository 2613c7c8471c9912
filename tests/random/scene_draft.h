// Shared state of the generators of a random scene: random numbers, the text of the scene file, and the
// transform to the world.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "random/random_numbers.h"
#include "random/random_scene.h"
#include "random/scene_text.h"

namespace phlux::test {

/// `structure` draws what determines the kernel, `values` everything else. Lengths are in units of the half
/// edge of the room until to_world() or in_world() scales and moves them.
class SceneDraft {
public:
  SceneDraft(const SceneNumber& number, const std::optional<Twin>& twin);

  RandomNumbers structure, values;
  RandomNumbers further; ///< of the structure as well; draws from it leave those of `structure` as they are
  std::optional<Twin> twin;
  SceneText text;
  std::map<std::string, std::string> files; ///< bytes of meshes and images by file name
  double scale = 1;
  scene::Vec3 offset{0.0};
  bool closed = false; ///< a room about the camera

  /// The result of `draw` from `values`; in a twin with new places, from other random numbers. `values`
  /// advance equally in both cases.
  template<class Draw>
  auto place(const Draw& draw) {
    const auto first = draw(values);
    return places_ ? draw(*places_) : first;
  }

  [[nodiscard]] scene::Vec3 in_world(const scene::Vec3& p) const { return scale * p + offset; }
  void open_to_world();
  /// Ends a transform with that from the units of the room to the world.
  void close_to_world();

private:
  std::optional<RandomNumbers> places_;
};

/// An image in the format RGBE without compression, which narrow images have. No channel is above its colour.
[[nodiscard]] std::string rgbe_file(int width, const std::vector<scene::Rgb>& pixels);
[[nodiscard]] scene::Vec3 triple(RandomNumbers& random, double from, double to);
[[nodiscard]] scene::Vec3 unit_vector(RandomNumbers& random);
/// A point above the floor and in front of the objects, between two distances from the origin.
[[nodiscard]] scene::Vec3 above_floor(RandomNumbers& random, double nearest, double farthest);
/// A direction perpendicular to `axis`.
[[nodiscard]] scene::Vec3 up_for(const scene::Vec3& axis);
[[nodiscard]] std::string attribute(const char* name, const scene::Vec3& value);
/// <lookat .../>
[[nodiscard]] std::string look_at(const char* tag, const scene::Vec3& origin, const scene::Vec3& target,
                                  const scene::Vec3& up);

} // namespace phlux::test
