// <bsdf>: the reflectance models of the library, and twosided around one of them.
#pragma once

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

/// The index of `material` in `materials`, to which it is added unless it has an equal one.
[[nodiscard]] int share(std::vector<scene::Material>& materials, const scene::Material& material);

} // namespace phlux::scene_file
