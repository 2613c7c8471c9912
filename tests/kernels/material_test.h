// Materials on the device under test: evaluated, sampled and integrated, for any strategy and width.
#pragma once

#include <string>
#include <vector>

#include "device_test.h"
#include "directions.h"
#include "lobes/models.h"
#include "measure/device_model.h"

namespace device_test {

using phlux::lobes::phong;
using phlux::measure::DeviceModel;
using phlux::measure::PairValues;
using phlux::measure::Sample;

inline DeviceModel device_model(Variant variant, const std::vector<phlux::scene::Material>& materials,
                                const std::string& strategy) {
  std::map<std::string, std::string> defines;
  if (variant.portable) defines["LANES_PORTABLE"] = "1";
  return {test_device(), kernel_files(), variant.width, strategy, materials, defines};
}

/// f_r and densities for one fixed direction and each of `generated`.
inline std::vector<PairValues> evaluate(const DeviceModel& model, int material, const glm::dvec3& fixed,
                                        const std::vector<glm::dvec3>& generated) {
  std::vector<phlux::measure::Pair> pairs;
  for (const glm::dvec3& direction : generated) pairs.push_back({fixed, direction});
  return model.evaluate(material, pairs);
}

inline phlux::scene::Material anisotropic(const phlux::scene::Rgb& diffuse, const phlux::scene::Rgb& specular,
                                          double exponent_u, double exponent_v) {
  return phlux::lobes::anisotropic_phong(diffuse, specular, exponent_u, exponent_v);
}

} // namespace device_test
