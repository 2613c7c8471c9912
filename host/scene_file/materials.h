// <bsdf>: the reflectance models of the library, and twosided around one of them.
#pragma once

#include <vector>

#include "lobes/models.h"
#include "scene/scene.h"
#include "scene_file/document.h"

namespace phlux::scene_file {

/// What to do where a material may reflect more than arrives, unless the <bsdf> itself says.
enum class ExcessEnergy { error, scale };

struct MaterialRules {
  const lobes::Library& library; ///< the models that may be named
  ExcessEnergy excess = ExcessEnergy::error;
};

/// @throws SceneError for values outside the ranges that the model declares, and for what is not supported
[[nodiscard]] scene::Material read_material(const Element& bsdf, const Document& document,
                                            MaterialRules rules);

/// The index of `material` in `materials`, where equal materials are one.
[[nodiscard]] int share(std::vector<scene::Material>& materials, const scene::Material& material);

} // namespace phlux::scene_file
