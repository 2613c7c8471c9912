// The host's part of the built-in models, besides the declaration in their kernel files. A new model is a
// ShippedModel in a file of its own and an entry in PHLUX_SHIPPED_MODELS.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/model.h"

namespace phlux::lobes {

/// Tables that models look up values in: one row per model and key.
struct LobeTables {
  std::vector<float> values;
  std::map<std::pair<std::string, double>, int> rows; ///< model and key -> index of the first value
};

struct ShippedModel {
  const char* name;
  const char* file; ///< of kernels/
  /// Upper bound on the fraction of light reflected in any channel; energy is conserved if it is at most 1.
  double (*largest_reflectance)(const scene::Material&);
  /// The words of NAME_DERIVED; may add rows to the tables. Null: no such words.
  std::vector<float> (*derive)(const scene::Material&, LobeTables& tables) = nullptr;
  /// The same reflectance function by a simpler model. Null: none is simpler.
  scene::Material (*simplest)(const scene::Material&) = nullptr;
};

/// The built-in models, in their order in messages. Each is defined as NAME_model in a file of host/lobes.
#define PHLUX_SHIPPED_MODELS(MODEL)                                                                          \
  MODEL(diffuse)                                                                                             \
  MODEL(phong)                                                                                               \
  MODEL(anisotropicphong)                                                                                    \
  MODEL(mirror)                                                                                              \
  MODEL(conductor)                                                                                           \
  MODEL(dielectric)                                                                                          \
  MODEL(thindielectric)                                                                                      \
  MODEL(roughconductor)                                                                                      \
  MODEL(roughdielectric)                                                                                     \
  MODEL(plastic) MODEL(roughplastic) MODEL(anisotropicconductor) MODEL(anisotropicdielectric)

#define PHLUX_DECLARE_MODEL(name) extern const ShippedModel name##_model;
PHLUX_SHIPPED_MODELS(PHLUX_DECLARE_MODEL)
#undef PHLUX_DECLARE_MODEL

[[nodiscard]] std::span<const ShippedModel* const> shipped_models();
[[nodiscard]] const ShippedModel* find_shipped(const scene::Model& model); ///< null for a user's model

[[nodiscard]] float largest_channel(const scene::Rgb& rgb);
[[nodiscard]] float bits_of(int index); ///< an index, bit for bit, in an array of float

} // namespace phlux::lobes
