#include "tables/material_table.h"

#include <algorithm>
#include <map>

#include "phong/reflectivity.h"

namespace phlux::tables {
namespace {

float largest(const scene::Rgb& rgb) {
  return static_cast<float>(std::max({rgb.r, rgb.g, rgb.b}));
}

int flags_of(const scene::Material& material) {
  int flags = material.kind == scene::Material::Kind::anisotropic_phong ? MATERIAL_ANISOTROPIC : 0;
  if (material.reflects()) flags |= MATERIAL_FRONT | (material.two_sided ? MATERIAL_BACK : 0);
  return flags;
}

} // namespace

MaterialTable material_table(const std::vector<scene::Material>& materials) {
  MaterialTable table;
  std::map<double, int> row_of_exponent;
  for (const scene::Material& material : materials) {
    const bool anisotropic = material.kind == scene::Material::Kind::anisotropic_phong;
    MaterialRecord record{};
    for (int i = 0; i < 3; ++i) {
      record.diffuse[i] = static_cast<float>(material.diffuse[i]);
      record.specular[i] = static_cast<float>(material.specular[i]);
    }
    record.exponent = static_cast<float>(material.exponent_u);
    record.exponent_v = static_cast<float>(material.exponent_v);
    record.diffuse_max = largest(material.diffuse);
    record.specular_max = largest(material.specular);
    record.flags = flags_of(material);
    if (!anisotropic && material.specular != scene::Rgb(0.0)) {
      const auto [row, is_new] = row_of_exponent.try_emplace(material.exponent_u, 0);
      if (is_new) row->second = phong::append_reflectivities(material.exponent_u, table.reflectivity);
      record.table_row = row->second;
      record.grazing_reflectivity = static_cast<float>(phong::grazing_reflectivity(material.exponent_u));
      record.table_scale =
          static_cast<float>(phong::reflectivity_intervals / phong::whole_lobe_cosine(material.exponent_u));
    }
    table.records.push_back(record);
  }
  return table;
}

} // namespace phlux::tables
