#include "lobes/program.h"

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include "lobes/shipped.h"
#include "scene/hash.h"
#include "scene/scene_data.h"

namespace phlux::lobes {
namespace {

std::size_t words_of(const scene::Parameter& parameter) {
  return parameter.kind == scene::Parameter::Kind::colour ? 3 : 1;
}

int parameter_words(const scene::Model& model) {
  int words = model.derived_words;
  for (const scene::Parameter& parameter : model.parameters) words += static_cast<int>(words_of(parameter));
  return words;
}

int record_words(const std::vector<ModelPointer>& models, bool masked) {
  int most = 0;
  for (const ModelPointer& model : models) most = std::max(most, parameter_words(*model));
  return MATERIAL_HEADER + most + (masked ? MATERIAL_OPACITY_WORDS : 0);
}

std::string capitalised(const std::string& name) {
  return macro_prefix(name.substr(0, 1)) + name.substr(1);
}

bool has(const std::vector<ModelPointer>& models, bool scene::Model::*property) {
  return std::ranges::any_of(models, [&](const ModelPointer& m) { return (*m).*property; });
}

scene::Material as_phong(const scene::Material& diffuse) {
  scene::Material material = phong(scene::Rgb(0.0), scene::Rgb(0.0), 0.0);
  material.take("diffuse_reflectance", diffuse, "reflectance");
  material.two_sided = diffuse.two_sided;
  material.opacity = diffuse.opacity;
  material.opacity_texture = diffuse.opacity_texture;
  return material;
}

/// Appends the words of a material's parameters.
void append_words(std::vector<float>& records, const scene::Material& material, LobeTables& tables) {
  for (std::size_t i = 0; i < material.values.size(); ++i) {
    const bool colour = material.model->parameters[i].kind == scene::Parameter::Kind::colour;
    for (int channel = 0; channel < (colour ? 3 : 1); ++channel)
      records.push_back(static_cast<float>(material.values[i][channel]));
  }
  const ShippedModel* model = find_shipped(*material.model);
  if (!model || !model->derive) return;
  const std::vector<float> derived = model->derive(material, tables);
  records.insert(records.end(), derived.begin(), derived.end());
}

/// The words of texture numbers, see MaterialTable::texture_numbers.
class TextureNumbers {
public:
  explicit TextureNumbers(MaterialTable& table) : table_(table) {}

  /// Of a material whose record begins at `first`, and whose opacity is at `opacity`.
  void set(const scene::Material& material, std::size_t first, std::size_t opacity) {
    std::size_t word = first + MATERIAL_HEADER;
    for (std::size_t i = 0; i < material.values.size(); ++i) {
      set(word, material.texture(i));
      word += words_of(material.model->parameters[i]);
    }
    set(opacity, material.opacity_texture);
  }

private:
  void set(std::size_t word, const scene::TexturePointer& texture) {
    if (!texture) return;
    table_.texture_numbers.resize(std::max(table_.texture_numbers.size(), word + 1));
    table_.texture_numbers[word] = 1 + number(texture);
  }

  int number(const scene::TexturePointer& texture) {
    auto& list = table_.textures;
    const std::size_t hash = scene::hash_of(*texture);
    const auto [first, last] = numbers_.equal_range(hash);
    for (auto each = first; each != last; ++each)
      if (*list[static_cast<std::size_t>(each->second)] == *texture) return each->second;
    numbers_.emplace(hash, static_cast<int>(list.size()));
    list.push_back(texture);
    return static_cast<int>(list.size()) - 1;
  }

  MaterialTable& table_;
  std::unordered_multimap<std::size_t, int> numbers_; ///< by hash
};

} // namespace

std::vector<ModelPointer> models_of(const std::vector<scene::Material>& materials) {
  std::vector<ModelPointer> models;
  for (const scene::Material& material : materials)
    if (std::ranges::find(models, material.model) == models.end()) models.push_back(material.model);
  if (std::ranges::find(models, shipped("phong")) != models.end()) std::erase(models, shipped("diffuse"));
  if (models.empty()) models.push_back(shipped("diffuse"));
  std::ranges::sort(models, {}, [](const ModelPointer& m) { return m->name; });
  return models;
}

std::map<std::string, std::string> files_of(const std::vector<ModelPointer>& models) {
  std::map<std::string, std::string> files;
  std::string text, list;
  int number = 0;
  for (const ModelPointer& model : models) {
    const std::string name = macro_prefix(model->name);
    if (model->derived_words == 0) text += fmt::format("#define {}_DERIVED(NUMBER, INDEX)\n", name);
    if (!model->transmits)
      text += fmt::format("#define {0}_TRANSMITS 0\n#define {0}_INDEX(m) (Real)(1.0f)\n", name);
    text += fmt::format("#include \"{}\"\n", model->file);
    if (!model->has_textured) text += fmt::format("#define {}_TEXTURED(m) (m)\n", name);
    if (!model->has_survival)
      text += fmt::format("#define {}_SURVIVAL(m, fixed, random) vec_max({}_reflectivity(m, fixed))\n", name,
                          model->name);
    list += fmt::format(" MODEL({}, {}, {}, {})", number++, model->name, capitalised(model->name), name);
    if (!model->text.empty()) files[model->file] = model->text;
  }
  files["lobes/models.cl"] =
      fmt::format("#include \"lobes/lobe.h\"\n{}#define MODELS(MODEL){}\n", text, list);
  return files;
}

bool any_masked(const std::vector<scene::Material>& materials) {
  return std::ranges::any_of(materials, &scene::Material::is_masked);
}

std::map<std::string, std::string> defines_of(const std::vector<ModelPointer>& models, bool masked) {
  return {{"MODEL_COUNT", std::to_string(models.size())},
          {"MATERIAL_WORDS", std::to_string(record_words(models, masked))},
          {"HAS_DELTA", has(models, &scene::Model::has_delta) ? "1" : "0"},
          {"HAS_TRANSMISSION", has(models, &scene::Model::transmits) ? "1" : "0"},
          {"HAS_TANGENTS", has(models, &scene::Model::needs_tangents) ? "1" : "0"}};
}

MaterialTable material_table(const std::vector<scene::Material>& materials,
                             std::vector<ModelPointer> models) {
  MaterialTable table{std::move(models), {}, materials.size(), {}, {}, {}};
  TextureNumbers texture_numbers(table);
  const bool masked = any_masked(materials);
  const auto words = static_cast<std::size_t>(record_words(table.models, masked));
  const bool has_phong = std::ranges::find(table.models, shipped("phong")) != table.models.end();
  LobeTables tables;
  for (const scene::Material& given : materials) {
    const bool stands_for = has_phong && given.model == shipped("diffuse");
    const scene::Material material = stands_for ? as_phong(given) : given;
    const auto found = std::ranges::find(table.models, material.model);
    const std::size_t end = table.records.size() + words;
    if (found != table.models.end()) {
      const bool transmits = material.model->transmits;
      const int sides = MATERIAL_FRONT | (material.two_sided || transmits ? MATERIAL_BACK : 0) |
                        (transmits ? MATERIAL_TRANSMITS : 0);
      const int flags = (reflects(material) ? sides : 0) | (given.is_textured() ? MATERIAL_TEXTURED : 0) |
                        (given.is_masked() ? MATERIAL_MASKED : 0);
      texture_numbers.set(material, table.records.size(), end - MATERIAL_OPACITY_WORDS);
      table.records.push_back(bits_of(static_cast<int>(found - table.models.begin())));
      table.records.push_back(bits_of(flags));
      append_words(table.records, material, tables);
    }
    table.records.resize(end);
    for (int channel = 0; masked && channel < MATERIAL_OPACITY_WORDS; ++channel)
      table.records[end - MATERIAL_OPACITY_WORDS + static_cast<std::size_t>(channel)] =
          static_cast<float>(given.opacity[channel]);
  }
  if (!table.textures.empty()) table.texture_numbers.resize(table.records.size());
  // A material without a table has row 0 all the same: kernels read two neighbouring values of it.
  if (tables.values.empty()) tables.values.resize(2);
  table.tables = std::move(tables.values);
  return table;
}

MaterialTable material_table(const std::vector<scene::Material>& materials) {
  return material_table(materials, models_of(materials));
}

} // namespace phlux::lobes
