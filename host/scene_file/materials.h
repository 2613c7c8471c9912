// <bsdf>: diffuse, phong, anisotropicphong, and twosided around one of them.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "scene_file/document.h"

namespace phlux::scene_file {

/// What to do where diffuse + specular exceeds 1 in a channel, unless the <bsdf> itself says.
enum class ExcessEnergy { error, scale };

/// @throws SceneError for values outside their ranges (Material's), and for what is not supported
[[nodiscard]] scene::Material read_material(const Element& bsdf, const Document& document,
                                            ExcessEnergy excess);

/// The index of `material` in `materials`, where equal materials are one.
[[nodiscard]] int share(std::vector<scene::Material>& materials, const scene::Material& material);

} // namespace phlux::scene_file
