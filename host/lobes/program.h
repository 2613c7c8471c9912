// Files and defines of a program's reflectance models, and the table of a scene's materials.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lobes/models.h"

namespace phlux::lobes {

/// The models that a program for these materials needs, sorted by name. If there is a phong, diffuse
/// materials become phongs with ks = 0: one model is faster than two.
[[nodiscard]] std::vector<ModelPointer> models_of(const std::vector<scene::Material>& materials);

/// The files that the program includes besides those of kernels/: lobes/models.cl and users' models.
[[nodiscard]] std::map<std::string, std::string> files_of(const std::vector<ModelPointer>& models);
/// MODEL_COUNT, MATERIAL_WORDS, HAS_DELTA, HAS_TRANSMISSION, HAS_TANGENTS. `masked`: for materials of which
/// some are masked.
[[nodiscard]] std::map<std::string, std::string> defines_of(const std::vector<ModelPointer>& models,
                                                            bool masked);
[[nodiscard]] bool any_masked(const std::vector<scene::Material>& materials);

/// Materials for kernels/lobes/material.cl: records of equal length, and the models' tables. A material whose
/// model is not among `models` has a record of zeros.
struct MaterialTable {
  std::vector<ModelPointer> models;
  std::vector<float> records;
  std::size_t count = 0; ///< number of records
  std::vector<float> tables;
  std::vector<scene::TexturePointer> textures; ///< of all materials
  /// As long as `records`: at the first word of a colour or opacity from a texture, 1 + its index in
  /// `textures`; elsewhere 0. Empty if there are no textures.
  std::vector<int> texture_numbers;
};
[[nodiscard]] MaterialTable material_table(const std::vector<scene::Material>& materials,
                                           std::vector<ModelPointer> models);
/// For the models of these materials.
[[nodiscard]] MaterialTable material_table(const std::vector<scene::Material>& materials);

} // namespace phlux::lobes
