// What the kernels of a scene are told of its reflectance models, and the records of its materials.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lobes/models.h"

namespace phlux::lobes {

/// The models that a program for these materials needs, in a fixed order. Diffuse materials are phongs
/// without a lobe where there is a phong: one model for both is faster than a choice between two.
[[nodiscard]] std::vector<ModelPointer> models_of(const std::vector<scene::Material>& materials);

/// The files that the program includes besides kernels/: lobes/models.cl and the users' own.
[[nodiscard]] std::map<std::string, std::string> files_of(const std::vector<ModelPointer>& models);
/// MODEL_COUNT, MATERIAL_WORDS, HAS_DELTA, HAS_TANGENTS.
[[nodiscard]] std::map<std::string, std::string> defines_of(const std::vector<ModelPointer>& models);

/// Materials as kernels/lobes/material.cl reads them: records of equal length, and the tables of the models.
/// A material whose model is not among `models` gets a record of zeros.
struct MaterialTable {
  std::vector<ModelPointer> models;
  std::vector<float> records;
  std::size_t count = 0; ///< of records
  std::vector<float> tables;
};
[[nodiscard]] MaterialTable material_table(const std::vector<scene::Material>& materials,
                                           std::vector<ModelPointer> models);
/// For the models of these materials.
[[nodiscard]] MaterialTable material_table(const std::vector<scene::Material>& materials);

} // namespace phlux::lobes
