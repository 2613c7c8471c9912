// Reflectance models, as their kernel files declare them (kernels/lobes/lobe.h), and materials.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "scene/texture.h"

namespace phlux::scene {

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
  bool has_textured = false; ///< has derived members that depend on colours
};

/// A model and the values of its parameters; a number is repeated in every channel. The value of a colour
/// from a texture is its largest, so that a bound on the material's reflectance bounds it at every point.
struct Material {
  std::shared_ptr<const Model> model;
  std::vector<Rgb> values;
  bool two_sided = false;               ///< reflects on both sides; otherwise the back is black
  std::vector<TexturePointer> textures; ///< by parameter, null for a constant; empty: all are constant
  Rgb opacity{1.0};                     ///< the part 1 - opacity of all light passes straight on
  TexturePointer opacity_texture = {};  ///< null: `opacity`, which is else its largest

  /// @throws std::out_of_range for a parameter that the model does not have
  [[nodiscard]] const Rgb& value(const std::string& parameter) const { return values.at(index(parameter)); }
  [[nodiscard]] Rgb& value(const std::string& parameter) { return values.at(index(parameter)); }
  /// The parameter's texture; null if it is constant.
  [[nodiscard]] TexturePointer texture(std::size_t parameter) const {
    return parameter < textures.size() ? textures[parameter] : nullptr;
  }
  void set_texture(std::size_t parameter, const TexturePointer& texture) {
    textures.resize(values.size());
    textures[parameter] = texture;
    values[parameter] = texture->largest();
  }
  /// Takes the value and the texture of another material's parameter.
  void take(const std::string& parameter, const Material& from, const std::string& its) {
    value(parameter) = from.value(its);
    if (const TexturePointer taken = from.texture(from.index(its))) set_texture(index(parameter), taken);
  }
  void set_opacity(const TexturePointer& texture) {
    opacity_texture = texture;
    opacity = texture->largest();
  }
  [[nodiscard]] bool is_masked() const { return opacity_texture || opacity != Rgb(1.0); }
  [[nodiscard]] bool is_textured() const { return !textures.empty() || opacity_texture; }
  bool operator==(const Material& other) const {
    const auto equal = [](const TexturePointer& a, const TexturePointer& b) {
      return a == b || (a && b && *a == *b);
    };
    return model == other.model && values == other.values && two_sided == other.two_sided &&
           std::equal(textures.begin(), textures.end(), other.textures.begin(), other.textures.end(),
                      equal) &&
           opacity == other.opacity && equal(opacity_texture, other.opacity_texture);
  }

private:
  [[nodiscard]] std::size_t index(const std::string& parameter) const {
    std::size_t i = 0;
    while (i < model->parameters.size() && model->parameters[i].name != parameter) ++i;
    return i;
  }
};

} // namespace phlux::scene
