#include "lobes/models.h"

#include <algorithm>
#include <cctype>
#include <iterator>

#include <fmt/format.h>

#include "errors.h"
#include "input_file.h"
#include "lobes/shipped.h"

namespace phlux::lobes {
namespace {

ModelPointer read_shipped(const ShippedModel& model) {
  return std::make_shared<const scene::Model>(
      read_declaration(model.name, model.file, sources::KernelFiles().read(model.file)));
}

const std::vector<ModelPointer>& all_shipped() {
  static const std::vector<ModelPointer> models = [] {
    std::vector<ModelPointer> list;
    for (const ShippedModel* each : shipped_models()) list.push_back(read_shipped(*each));
    return list;
  }();
  return models;
}

scene::Material material(const std::string& model, std::vector<scene::Rgb> values) {
  scene::Material m;
  m.model = shipped(model);
  m.values = std::move(values);
  return m;
}

// Otherwise the compiler would report a missing function in lobes/material.cl, which calls it.
void require_functions(const std::string& name, const std::string& path, const std::string& text) {
  for (const char* function : {"_evaluate", "_sample", "_reflectivity"})
    if (text.find(name + function) == std::string::npos)
      throw SceneError(
          fmt::format("{0}: there is no function {1}{2}: a model {1} defines {1}_evaluate, {1}_sample and "
                      "{1}_reflectivity (kernels/lobes/lobe.h)",
                      path, name, function));
}

bool is_identifier(const std::string& name) {
  return !name.empty() && std::islower(static_cast<unsigned char>(name.front())) != 0 &&
         std::ranges::all_of(
             name, [](unsigned char c) { return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '_'; });
}

} // namespace

Library::Library() : models_(all_shipped()) {}

Library::Library(const std::vector<std::filesystem::path>& files) : Library() {
  for (const std::filesystem::path& file : files) add(file);
}

ModelPointer Library::find(const std::string& name) const {
  const auto found = std::ranges::find(models_, name, [](const ModelPointer& m) { return m->name; });
  return found == models_.end() ? nullptr : *found;
}

void Library::add(const std::filesystem::path& file) {
  const std::string name = file.stem().string(), path = file.string();
  if (file.extension() != ".cl" || !is_identifier(name))
    throw SceneError(fmt::format("{}: not the name of a reflectance model: NAME.cl, where NAME is made of "
                                 "lower case letters, digits and underscores",
                                 path));
  if (find(name))
    throw SceneError(fmt::format("{}: there is a model {} already: give the file another name", path, name));
  const auto read = kernel_text_of(file);
  if (!read)
    throw SceneError(fmt::format("{}: the reflectance model cannot be read: an existing file", path));
  const std::string& text = *read;
  scene::Model model = read_declaration(name, path, text);
  if (model.derived_words > 0)
    throw SceneError(fmt::format("{}: only models that ship have derived parameters: compute them in the "
                                 "model's functions",
                                 path));
  require_functions(name, path, text);
  model.text = text;
  models_.push_back(std::make_shared<const scene::Model>(std::move(model)));
}

const ModelPointer& shipped(const std::string& name) {
  return *std::ranges::find(all_shipped(), name, [](const ModelPointer& m) { return m->name; });
}

scene::Material diffuse(const scene::Rgb& reflectance) {
  return material("diffuse", {reflectance});
}
scene::Material phong(const scene::Rgb& diffuse, const scene::Rgb& specular, double exponent) {
  return material("phong", {diffuse, specular, scene::Rgb(exponent)});
}
scene::Material anisotropic_phong(const scene::Rgb& diffuse, const scene::Rgb& specular, double exponent_u,
                                  double exponent_v) {
  return material("anisotropicphong", {diffuse, specular, scene::Rgb(exponent_u), scene::Rgb(exponent_v)});
}
scene::Material mirror(const scene::Rgb& specular) {
  return material("mirror", {specular});
}
scene::Material conductor(const scene::Rgb& eta, const scene::Rgb& k, const scene::Rgb& specular) {
  return material("conductor", {eta, k, specular});
}
scene::Material dielectric(double index, const scene::Rgb& reflectance, const scene::Rgb& transmittance) {
  return material("dielectric", {scene::Rgb(index), scene::Rgb(1.0), reflectance, transmittance});
}

bool reflects(const scene::Material& material) {
  const ShippedModel* model = find_shipped(*material.model);
  return !model || model->largest_reflectance(material) > 0;
}

double largest_reflectance(const scene::Material& material) {
  const ShippedModel* model = find_shipped(*material.model);
  return model ? model->largest_reflectance(material) : 0;
}

scene::Material simplest(const scene::Material& material) {
  const ShippedModel* model = find_shipped(*material.model);
  if (!model || !model->simplest) return material;
  scene::Material simple = model->simplest(material);
  simple.two_sided = material.two_sided;
  return simple;
}

} // namespace phlux::lobes
