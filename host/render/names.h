// What options call the values of a setting.
#pragma once

#include <string>

#include "render/render.h"

namespace phlux::render {

[[nodiscard]] inline const std::string& name_of(Connect value) {
  return connect_names()[static_cast<std::size_t>(value)];
}
[[nodiscard]] inline const std::string& name_of(Weights value) {
  return weights_names()[static_cast<std::size_t>(value)];
}
[[nodiscard]] inline const std::string& name_of(LightSelection value) {
  return light_selection_names()[static_cast<std::size_t>(value)];
}

} // namespace phlux::render
