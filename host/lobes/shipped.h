// What the host knows of a model that ships besides its declaration: one such record in a file of its own,
// and one line in the list.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/model.h"

namespace phlux::lobes {

/// Rows of numbers that models look up; a row for a key is made once.
struct LobeTables {
  std::vector<float> values;
  std::map<std::pair<std::string, double>, int> rows; ///< by model and key: the index of the first value
};

struct ShippedModel {
  const char* name;
  const char* file; ///< of kernels/
  /// The largest fraction of light that it may reflect in a channel: at most 1 where energy is conserved.
  double (*largest_reflectance)(const scene::Material&);
  /// The words of NAME_DERIVED; may add rows to the tables. Null: there are none.
  std::vector<float> (*derive)(const scene::Material&, LobeTables& tables) = nullptr;
  /// The same reflectance function by a simpler model. Null: as it is.
  scene::Material (*simplest)(const scene::Material&) = nullptr;
};

/// The models that ship, in the order in which messages name them. NAME_model is in a file of host/lobes.
#define PHLUX_SHIPPED_MODELS(MODEL) MODEL(diffuse) MODEL(phong) MODEL(anisotropicphong) MODEL(conductor)

#define PHLUX_DECLARE_MODEL(name) extern const ShippedModel name##_model;
PHLUX_SHIPPED_MODELS(PHLUX_DECLARE_MODEL)
#undef PHLUX_DECLARE_MODEL

[[nodiscard]] std::span<const ShippedModel* const> shipped_models();
[[nodiscard]] const ShippedModel* find_shipped(const scene::Model& model); ///< null for a user's own

[[nodiscard]] float largest_channel(const scene::Rgb& rgb);
[[nodiscard]] float bits_of(int index); ///< an index among words that are floats

} // namespace phlux::lobes
