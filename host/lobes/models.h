// The reflectance models: those that ship, and those that a user brings in a kernel file of their own.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scene/model.h"
#include "sources/kernel_files.h"

namespace phlux::lobes {

using ModelPointer = std::shared_ptr<const scene::Model>;

/// What a kernel file declares of the model NAME: NAME_PARAMETERS, NAME_DERIVED, NAME_HAS_DELTA and so on.
/// @throws SceneError "FILE:LINE: ..." for a declaration that cannot be read
[[nodiscard]] scene::Model read_declaration(const std::string& name, const std::string& file,
                                            const std::string& text);

/// The models that a scene file may name.
class Library {
public:
  Library(); ///< those that ship
  /// Those, and users' own. @throws SceneError as add
  explicit Library(const std::vector<std::filesystem::path>& files);
  /// A user's own: FILE is NAME.cl, and NAME is the type of its <bsdf>.
  /// @throws SceneError when it cannot be read, is malformed, lacks a function, or has the name of another
  /// model
  void add(const std::filesystem::path& file);
  [[nodiscard]] ModelPointer find(const std::string& name) const; ///< null if there is none
  [[nodiscard]] const std::vector<ModelPointer>& models() const { return models_; }

private:
  std::vector<ModelPointer> models_;
};

/// A model that ships, by its name.
[[nodiscard]] const ModelPointer& shipped(const std::string& name);

// Materials of the models that ship.
[[nodiscard]] scene::Material diffuse(const scene::Rgb& reflectance);
[[nodiscard]] scene::Material phong(const scene::Rgb& diffuse, const scene::Rgb& specular, double exponent);
[[nodiscard]] scene::Material anisotropic_phong(const scene::Rgb& diffuse, const scene::Rgb& specular,
                                                double exponent_u, double exponent_v);
[[nodiscard]] scene::Material conductor(const scene::Rgb& specular);

/// Whether it reflects anything: a model that ships does not if all of its colours are 0.
[[nodiscard]] bool reflects(const scene::Material& material);
/// The largest fraction of light that it may reflect in a channel, as far as its parameters bound it: for a
/// phong kd + ks.
[[nodiscard]] double largest_reflectance(const scene::Material& material);
/// The same reflectance function by the simplest model and parameters: a phong without a lobe is diffuse.
[[nodiscard]] scene::Material simplest(const scene::Material& material);

} // namespace phlux::lobes
