#include "lobes/models.h"
#include "lobes/shipped.h"
#include "phong/reflectivity.h"

namespace phlux::lobes {
namespace {

double diffuse_plus_specular(const scene::Material& m) {
  return largest_channel(m.value("diffuse_reflectance") + m.value("specular_reflectance"));
}

std::vector<float> derive(const scene::Material& m, LobeTables& tables) {
  const scene::Rgb specular = m.value("specular_reflectance");
  const double exponent = m.value("exponent").x;
  std::vector<float> words{largest_channel(m.value("diffuse_reflectance")), largest_channel(specular), 0, 0,
                           bits_of(0)};
  if (specular == scene::Rgb(0.0)) return words;
  words[2] = static_cast<float>(phong::reflectivity_intervals / phong::whole_lobe_cosine(exponent));
  words[3] = static_cast<float>(phong::grazing_reflectivity(exponent));
  const auto [row, is_new] = tables.rows.try_emplace({"phong", exponent}, 0);
  if (is_new) row->second = phong::append_reflectivities(exponent, tables.values);
  words[4] = bits_of(row->second);
  return words;
}

scene::Material without_lobe(const scene::Material& m) {
  if (m.value("specular_reflectance") != scene::Rgb(0.0)) return m;
  scene::Material material = diffuse(scene::Rgb(0.0));
  material.take("reflectance", m, "diffuse_reflectance");
  return material;
}

} // namespace

const ShippedModel phong_model{"phong", "phong/phong.cl", diffuse_plus_specular, derive, without_lobe};

} // namespace phlux::lobes
