#include "lobes/assignment.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "errors.h"

namespace phlux::lobes {
namespace {

// "specular_reflectance" for "specularReflectance".
std::string with_underscores(const std::string& name) {
  std::string result;
  bool capital = false; // intIOR: a row of capitals is one word
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isupper(letter) != 0 && !capital) result += '_';
    result += static_cast<char>(std::tolower(letter));
    capital = std::isupper(letter) != 0;
  }
  return result;
}

std::optional<std::vector<double>> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  const char *at = text.data(), *end = at + text.size();
  while (true) {
    double number{};
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
    if (stop == end) return numbers;
    if (*stop != ',' && *stop != ' ') return std::nullopt;
    at = stop + 1;
  }
}

} // namespace

scene::Material default_material(const ModelPointer& model) {
  scene::Material material;
  material.model = model;
  for (const scene::Parameter& parameter : model->parameters)
    material.values.emplace_back(parameter.default_value);
  return material;
}

const scene::Parameter* find_parameter(const scene::Model& model, const std::string& name) {
  const auto found = std::ranges::find(model.parameters, with_underscores(name), &scene::Parameter::name);
  return found == model.parameters.end() ? nullptr : &*found;
}

void assign(scene::Material& material, const std::string& name, const std::string& value) {
  const auto wrong = [&](const std::string& right) {
    return UsageError(fmt::format("`set` {}={}: {}", name, value, right));
  };
  const scene::Parameter* parameter = find_parameter(*material.model, name);
  if (parameter == nullptr) {
    std::string names;
    for (const scene::Parameter& each : material.model->parameters)
      names += (names.empty() ? "" : ", ") + each.name;
    throw wrong(fmt::format("{} has no such parameter: it has {}", material.model->name, names));
  }
  const bool colour = parameter->kind == scene::Parameter::Kind::colour;
  const auto numbers = numbers_of(value);
  if (!numbers || (numbers->size() != 1 && !(colour && numbers->size() == 3)))
    throw wrong(colour ? "must be a number, or three with commas between them" : "must be a number");
  for (const double number : *numbers)
    if (!(number >= parameter->lowest && number <= parameter->highest))
      throw wrong(fmt::format("must be from {:g} to {:g}", parameter->lowest, parameter->highest));
  material.value(parameter->name) = numbers->size() == 3
                                        ? scene::Rgb((*numbers)[0], (*numbers)[1], (*numbers)[2])
                                        : scene::Rgb(numbers->front());
}

} // namespace phlux::lobes
