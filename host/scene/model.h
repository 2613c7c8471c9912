// Reflectance models as a scene refers to them: what a kernel file declares of itself (kernels/lobes/lobe.h).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace phlux::scene {

using Rgb = glm::dvec3;

struct Parameter {
  enum class Kind { colour, number };
  std::string name; ///< as kernels and files of Mitsuba 2 and later spell it: specular_reflectance
  Kind kind = Kind::colour;
  double otherwise = 0, lowest = 0, highest = 1;
  std::string meaning;
};

struct Model {
  std::string name; ///< the prefix of its functions, and the type of its <bsdf>
  std::string file; ///< by which kernels include it
  std::string text; ///< of a user's own file; empty for a model that ships
  std::vector<Parameter> parameters;
  int derived_words = 0;  ///< of members that the host computes
  bool has_delta = false; ///< samples may be delta events
  bool needs_tangents = false;
  bool reflectivity_is_estimate = false;
  bool has_survival = false; ///< a survival probability of its own for roulette
};

/// A model and values for its parameters; a number is the same in every channel.
struct Material {
  std::shared_ptr<const Model> model;
  std::vector<Rgb> values;
  bool two_sided = false; ///< reflects on both sides; otherwise the back is black

  /// @throws std::out_of_range for a parameter that the model has not
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
