// <bsdf>: the reflectance models of the library, and twosided around one of them.
#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

#include "lobes/models.h"
#include "scene/scene.h"
#include "scene_file/document.h"
#include "scene_file/textures.h"

namespace phlux::scene_file {

/// Treatment of materials that may reflect more than arrives, unless the <bsdf> has its own.
enum class ExcessEnergy { error, scale };

struct MaterialRules {
  const lobes::Library& library; ///< the available models
  TextureReader& textures;
  ExcessEnergy excess = ExcessEnergy::error;
};

/// @throws SceneError for values outside the ranges that the model declares, and for unsupported types or
/// properties
[[nodiscard]] scene::Material read_material(const Element& bsdf, const Document& document,
                                            MaterialRules rules);

/// A list of materials, to which one is added unless the list has an equal one.
class SharedMaterials {
public:
  /// @param materials grows by index_of() alone from now on
  explicit SharedMaterials(std::vector<scene::Material>& materials);
  /// The index of a material that is equal to this one.
  [[nodiscard]] int index_of(const scene::Material& material);

private:
  std::vector<scene::Material>& materials_;
  std::unordered_multimap<std::size_t, int> indices_; ///< by hash
};

} // namespace phlux::scene_file
