// <transform>: steps that are applied to points in their order in the file.
#pragma once

#include <glm/mat4x4.hpp>

#include "scene_file/document.h"

namespace phlux::scene_file {

/// The product of the steps. @throws SceneError at the transform's line if it is singular, not finite or
/// projective. In version 0 of the format, <lookat> without `up` is another than in later ones.
[[nodiscard]] glm::dmat4 read_transform(const Element& transform, int major_version);

/// x, y and z of a <point>, <vector>, <translate>...: from attributes (`missing` if absent) or from three
/// numbers in `value`.
/// @throws SceneError
[[nodiscard]] glm::dvec3 read_triple(const Element& element, double missing);

/// Whether the linear part of `matrix` is a rotation or rotoreflection times a scale factor.
[[nodiscard]] bool is_similarity(const glm::dmat4& matrix);

/// Whether it preserves lengths: a similarity of scale 1.
[[nodiscard]] bool is_rigid(const glm::dmat4& matrix);

} // namespace phlux::scene_file
