// Reflectance models, as their kernel files declare them (kernels/lobes/lobe.h), and materials.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace phlux::scene {

using Rgb = glm::dvec3;

struct Parameter {
  enum class Kind { colour, number };
  std::string name; ///< in the spelling of kernels and of Mitsuba 2 and later: specular_reflectance
  Kind kind = Kind::colour;
  double default_value = 0, lowest = 0, highest = 1;
  std::string meaning;
};

struct Model {
  std::string name; ///< the prefix of its functions, and the type of its <bsdf>
  std::string file; ///< its kernel file, as kernels include it
  std::string text; ///< of a user's file; empty for a built-in model
  std::vector<Parameter> parameters;
  int derived_words = 0;  ///< words that the host computes
  bool has_delta = false; ///< samples may be delta events
  bool needs_tangents = false;
  bool transmits = false; ///< light passes through its surfaces, which scatter on both sides
  bool reflectivity_is_estimate = false;
  bool has_survival = false; ///< defines its own survival probability for roulette
};

/// A model and the values of its parameters; a number is repeated in every channel.
struct Material {
  std::shared_ptr<const Model> model;
  std::vector<Rgb> values;
  bool two_sided = false; ///< reflects on both sides; otherwise the back is black

  /// @throws std::out_of_range for a parameter that the model does not have
  [[nodiscard]] const Rgb& value(const std::string& parameter) const { return values.at(index(parameter)); }
  [[nodiscard]] Rgb& value(const std::string& parameter) { return values.at(index(parameter)); }
  bool operator==(const Material&) const = default;

private:
  [[nodiscard]] std::size_t index(const std::string& parameter) const {
    std::size_t i = 0;
    while (i < model->parameters.size() && model->parameters[i].name != parameter) ++i;
    return i;
  }
};

} // namespace phlux::scene
