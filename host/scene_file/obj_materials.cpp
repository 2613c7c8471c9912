#include "scene_file/obj_materials.h"

#include <sstream>

#include <glm/common.hpp>

#include "input_file.h"
#include "lobes/models.h"
#include "scene_file/color.h"
#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

using scene::Rgb;

struct Entry { ///< from one newmtl to the next
  Rgb diffuse{0.0}, specular{0.0};
  double exponent = 0.0;
  int illumination = 0;
};

/// The sum of reflectances after Mitsuba's scaling of materials that reflect more than arrives.
constexpr double kept_energy = 0.99;

scene::Material material_of(const Entry& entry) {
  const bool glossy = entry.illumination == 2 && entry.specular != Rgb(0.0) && entry.exponent > 0.0;
  scene::Material material =
      glossy ? lobes::phong(entry.diffuse, entry.specular, entry.exponent) : lobes::diffuse(entry.diffuse);
  const double most = lobes::largest_reflectance(material);
  if (most > 1.0)
    for (std::size_t i = 0; i < material.values.size(); ++i)
      if (material.model->parameters[i].kind == scene::Parameter::Kind::colour)
        material.values[i] *= kept_energy / most;
  return material;
}

Rgb color(const std::vector<std::string_view>& words, const Location& where) {
  Rgb result;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i + 1);
    const auto value = at < words.size() ? parse_real(words[at]) : std::nullopt;
    if (!value || *value < 0.0) fail(where, "a malformed colour", "three numbers of 0 or more");
    result[i] = decode_srgb(*value);
  }
  return result;
}

double number(const std::vector<std::string_view>& words, const Location& where) {
  const auto value = words.size() > 1 ? parse_real(words[1]) : std::nullopt;
  if (!value) fail(where, quoted(words[0]) + " without a number", "a finite number");
  return *value;
}

} // namespace

std::map<std::string, scene::Material> read_obj_materials(const std::filesystem::path& file,
                                                          const Location& named_at, Warnings& warnings) {
  std::map<std::string, Entry> entries;
  auto bytes = bytes_of(file);
  if (!bytes)
    warnings.add(named_at, "material library '" + file.string() + "' cannot be read; diffuse 0.5 is used",
                 "unreadable material library");
  std::istringstream stream(bytes.value_or(""));
  Location where{std::make_shared<const std::string>(file.string()), 1};
  Entry* entry = nullptr;
  for (std::string line; std::getline(stream, line); ++where.line) {
    const auto words = split(line);
    if (words.empty()) continue;
    const auto keyword = words[0];
    if (keyword == "newmtl")
      entry = words.size() > 1
                  ? &entries[std::string(words[1].data(), words.back().data() + words.back().size())]
                  : nullptr;
    if (!entry) continue;
    if (keyword == "Kd") entry->diffuse = color(words, where);
    if (keyword == "Ks") entry->specular = color(words, where);
    if (keyword == "Ns") entry->exponent = number(words, where);
    if (keyword == "illum") entry->illumination = static_cast<int>(number(words, where));
    if (keyword.starts_with("map_") || keyword == "bump" || (keyword == "d" && number(words, where) < 1.0) ||
        (keyword == "illum" && entry->illumination > 2))
      warnings.add(where, std::string(keyword) + " of a material library is not supported and not used");
  }
  std::map<std::string, scene::Material> materials;
  for (const auto& [name, found] : entries) materials.emplace(name, material_of(found));
  return materials;
}

} // namespace phlux::scene_file
