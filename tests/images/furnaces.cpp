#include "images/furnaces.h"

#include <algorithm>
#include <cmath>

#include "materials.h"
#include "phong/reflectivity.h"

namespace phlux::test {

using scene::Vec3;

namespace {

// rho_s / ks of one exponent as a function of the cosine. Linear interpolation between 2^14 values has an
// error below 1e-6.
class LobeReflectivity {
public:
  explicit LobeReflectivity(double exponent) {
    for (int i = 0; i <= intervals; ++i)
      values_.push_back(phong::lobe_reflectivity(exponent, static_cast<double>(i) / intervals));
  }
  double operator()(double cosine) const {
    const double position = std::min(cosine, 1.0) * intervals;
    const auto below = static_cast<std::size_t>(std::min(position, intervals - 1.0));
    return std::lerp(values_[below], values_[below + 1], position - static_cast<double>(below));
  }

private:
  static constexpr int intervals = 1 << 14;
  std::vector<double> values_;
};

} // namespace

double cosine_on_sphere(const Vec3& direction) {
  const double along = 4 * direction.z;
  const double discriminant = along * along - 15;
  return discriminant < 0 ? -1 : std::sqrt(discriminant);
}

scene::Scene sphere_furnace(double fov, int size, const scene::Material& material) {
  scene::Scene scene = shipped("furnace-sphere", size, size);
  scene.camera = look_at({0, 0, 4}, {0, 0, 0}, fov, size, size);
  scene.materials.assign(scene.materials.size(), material);
  scene.constant_radiance = scene::Rgb(sky[0], sky[1], sky[2]);
  return scene;
}

Estimate sphere_reference(const scene::Scene& scene, const scene::Material& material) {
  const LobeReflectivity lobe(exponent_of(material));
  return expected(scene.camera, [&](const Vec3& direction) {
    const double cosine = cosine_on_sphere(direction);
    Channels result = sky;
    for (int c = 0; c < 3 && cosine >= 0; ++c)
      result[static_cast<std::size_t>(c)] *=
          diffuse_of(material)[c] + specular_of(material)[c] * lobe(cosine);
    return result;
  });
}

} // namespace phlux::test
