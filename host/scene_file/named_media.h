// Indices of refraction that scene files give by name.
#pragma once

#include <optional>
#include <string>

#include "scene/scene.h"

namespace phlux::scene_file {

/// The index of refraction of a dielectric by Mitsuba's name, such as "water" or "bk7"; empty if there is
/// none.
[[nodiscard]] std::optional<double> index_of_dielectric(const std::string& name);
[[nodiscard]] std::string names_of_dielectrics(); ///< with commas between them

struct ComplexIndex {
  scene::Rgb eta, k;
};
/// The index of refraction of a metal, "Au" or Mitsuba's "Ni_palik"; empty if there is none.
[[nodiscard]] std::optional<ComplexIndex> index_of_metal(const std::string& name);
[[nodiscard]] std::string names_of_metals();

} // namespace phlux::scene_file
