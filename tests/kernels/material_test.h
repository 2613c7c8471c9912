// Runs the functions of materials on the device, for any strategy and width.
#pragma once

#include <string>
#include <vector>

#include "device_test.h"
#include "directions.h"
#include "lobes/models.h"
#include "scene_test.h"

namespace device_test {

struct Sample {
  Float3 direction, weight;
  float density;
  int survives, draws;
};

class MaterialProgram {
public:
  MaterialProgram(Variant variant, const std::vector<phlux::scene::Material>& materials,
                  const std::string& strategy)
      : program_(variant, "material.cl", scene_of(materials), strategy) {}

  [[nodiscard]] std::vector<Float3> eval(int material, const std::vector<Float3>& fixed,
                                         const std::vector<Float3>& generated) const {
    std::vector<Float3> values(generated.size());
    run("evaluate", values.size(), material, fixed, generated, out(values));
    return values;
  }
  [[nodiscard]] std::vector<float> density(int material, const std::vector<Float3>& fixed,
                                           const std::vector<Float3>& generated) const {
    std::vector<float> values(generated.size());
    run("density_of", values.size(), material, fixed, generated, out(values));
    return values;
  }
  /// For directions in the plane of x and z.
  [[nodiscard]] std::vector<Float3> reflectivity(int material, const std::vector<float>& cosines) const {
    std::vector<Float3> values(cosines.size());
    run("reflectivity_of", values.size(), material, cosines, out(values));
    return values;
  }
  [[nodiscard]] std::vector<Sample> sample(int material, const Float3& fixed, std::size_t count,
                                           std::uint32_t seed, bool roulette) const {
    std::vector<std::uint32_t> paths(count);
    for (std::size_t i = 0; i < count; ++i) paths[i] = static_cast<std::uint32_t>(i);
    std::vector<Sample> samples(count);
    const cl_uint2 key = {{seed, 0x5eed}};
    run("sample_of", count, material, std::vector<Float3>{fixed}, key, roulette ? 1 : 0, paths, out(samples));
    return samples;
  }

private:
  static phlux::scene::Scene scene_of(const std::vector<phlux::scene::Material>& materials) {
    phlux::scene::Scene scene;
    scene.materials = materials;
    // A shape of each material: programs contain only the models of materials that shapes have.
    for (std::size_t i = 0; i < materials.size(); ++i)
      scene.spheres.push_back({{3.0 * static_cast<double>(i), 0, 0}, 1, false, {static_cast<int>(i), -1}});
    return scene;
  }
  template<typename... Arguments>
  void run(const char* name, std::size_t count, const Arguments&... arguments) const {
    program_.run(name, count, arguments...);
  }

  SceneProgram program_;
};

using phlux::lobes::phong;
inline phlux::scene::Material anisotropic(const phlux::scene::Rgb& diffuse, const phlux::scene::Rgb& specular,
                                          double exponent_u, double exponent_v) {
  return phlux::lobes::anisotropic_phong(diffuse, specular, exponent_u, exponent_v);
}

} // namespace device_test
