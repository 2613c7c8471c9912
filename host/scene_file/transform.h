// <transform>: steps applied to points in the order in which they are written.
#pragma once

#include <glm/mat4x4.hpp>

#include "scene_file/document.h"

namespace phlux::scene_file {

/// The product of the steps. @throws SceneError at the transform's line if it is singular, not finite or
/// projective
[[nodiscard]] glm::dmat4 read_transform(const Element& transform);

/// x, y and z of a <point>, <vector>, <translate>...: as attributes (a missing one is `missing`) or three in
/// `value`.
/// @throws SceneError
[[nodiscard]] glm::dvec3 read_triple(const Element& element, double missing);

/// Whether the linear part of `matrix` is a rotation, perhaps with a mirroring, times one scale factor.
[[nodiscard]] bool is_similarity(const glm::dmat4& matrix);

/// Whether it keeps lengths: a similarity of scale 1.
[[nodiscard]] bool is_rigid(const glm::dmat4& matrix);

} // namespace phlux::scene_file
