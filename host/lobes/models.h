// The reflectance models: built-in ones and users' own from kernel files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scene/model.h"
#include "sources/kernel_files.h"

namespace phlux::lobes {

using ModelPointer = std::shared_ptr<const scene::Model>;

/// A model's name in capitals, which begins the names of its macros.
[[nodiscard]] std::string macro_prefix(std::string model);

/// The declaration of the model NAME in a kernel file: NAME_PARAMETERS, NAME_DERIVED, NAME_HAS_DELTA and so
/// on.
/// @throws SceneError "FILE:LINE: ..." for a declaration that cannot be read
[[nodiscard]] scene::Model read_declaration(const std::string& name, const std::string& file,
                                            const std::string& text);

/// The models that a scene file may name.
class Library {
public:
  Library(); ///< the built-in models
  /// The built-in models and users' own. @throws SceneError as add
  explicit Library(const std::vector<std::filesystem::path>& files);
  /// Adds a user's model: FILE is NAME.cl, and NAME is the type of its <bsdf>.
  /// @throws SceneError when the file cannot be read, is malformed, lacks a function, or has another model's
  /// name
  void add(const std::filesystem::path& file);
  [[nodiscard]] ModelPointer find(const std::string& name) const; ///< null if there is none
  [[nodiscard]] const std::vector<ModelPointer>& models() const { return models_; }

private:
  std::vector<ModelPointer> models_;
};

/// A built-in model by its name, which must exist.
[[nodiscard]] const ModelPointer& shipped(const std::string& name);

// Materials of the built-in models.
[[nodiscard]] scene::Material diffuse(const scene::Rgb& reflectance);
[[nodiscard]] scene::Material phong(const scene::Rgb& diffuse, const scene::Rgb& specular, double exponent);
[[nodiscard]] scene::Material anisotropic_phong(const scene::Rgb& diffuse, const scene::Rgb& specular,
                                                double exponent_u, double exponent_v);
[[nodiscard]] scene::Material mirror(const scene::Rgb& specular);
[[nodiscard]] scene::Material conductor(const scene::Rgb& eta, const scene::Rgb& k,
                                        const scene::Rgb& specular);
/// Glass of an index of refraction relative to the outside.
[[nodiscard]] scene::Material dielectric(double index, const scene::Rgb& reflectance = scene::Rgb(1.0),
                                         const scene::Rgb& transmittance = scene::Rgb(1.0));

/// False if the material scatters nothing: it is of a built-in model and its largest reflectance is 0.
[[nodiscard]] bool reflects(const scene::Material& material);
/// An upper bound, from the parameters, on the fraction of light that is reflected in any channel: kd + ks
/// for phong; 0 for a user's model, which is not checked.
[[nodiscard]] double largest_reflectance(const scene::Material& material);
/// The same reflectance function by the simplest model: a phong with ks = 0 becomes diffuse.
[[nodiscard]] scene::Material simplest(const scene::Material& material);

} // namespace phlux::lobes
