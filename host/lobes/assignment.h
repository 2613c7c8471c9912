// Materials from parameters as a user types them, NAME=VALUE.
#pragma once

#include <string>

#include "lobes/models.h"

namespace phlux::lobes {

/// A material with the default of every parameter.
[[nodiscard]] scene::Material default_material(const ModelPointer& model);

/// The parameter of this name, specular_reflectance or specularReflectance; null if the model has none.
[[nodiscard]] const scene::Parameter* find_parameter(const scene::Model& model, const std::string& name);

/// Sets a parameter of a material: a number, or for a colour one number or three, "0.1,0.2,0.3".
/// @throws UsageError "`set` NAME=VALUE: what would be right"
void assign(scene::Material& material, const std::string& name, const std::string& value);

} // namespace phlux::lobes
