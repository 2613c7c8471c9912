#include "verify/lobe/cases.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

namespace phlux::verify {
namespace {

using scene::Parameter;

constexpr double largest_value = 1000; // as an exponent: lobes of width 1 / 30, which the quadrature resolves

bool is_colour(const Parameter& parameter) {
  return parameter.kind == Parameter::Kind::colour;
}

scene::Material with_extreme(scene::Material material, const Parameter& extreme, double value) {
  for (const Parameter& other : material.model->parameters)
    if (is_colour(extreme) && is_colour(other) && value == extreme.highest)
      material.value(other.name) = scene::Rgb(other.lowest);
  material.value(extreme.name) = scene::Rgb(value);
  return material;
}

bool is_set(const Parameter& parameter, const scene::Model& model, const Assignments& assignments) {
  return std::ranges::any_of(
      assignments, [&](const auto& each) { return lobes::find_parameter(model, each.first) == &parameter; });
}

std::string name_of(const Assignments& assignments) {
  std::string name;
  for (const auto& [parameter, value] : assignments)
    name += fmt::format("{}{} {}", name.empty() ? "" : ", ", parameter, value);
  return name;
}

} // namespace

std::vector<NamedMaterial> materials_of(const lobes::ModelPointer& model, const Assignments& assignments) {
  std::vector<NamedMaterial> materials{{lobes::default_material(model), "defaults"}};
  scene::Material base = materials.front().material;
  for (const auto& [name, value] : assignments) lobes::assign(base, name, value);
  const std::string set = name_of(assignments);
  if (!assignments.empty()) materials.push_back({base, set});
  for (const Parameter& parameter : model->parameters) {
    if (is_set(parameter, *model, assignments)) continue;
    for (const double value : {parameter.lowest, std::min(parameter.highest, largest_value)})
      materials.push_back({with_extreme(base, parameter, value),
                           fmt::format("{}{}{} {:g}", set, set.empty() ? "" : ", ", parameter.name, value)});
  }
  std::erase_if(materials, [](const NamedMaterial& each) { return !lobes::reflects(each.material); });
  return materials;
}

std::vector<FixedDirection> fixed_directions(bool quick, bool both_sides) {
  std::vector<FixedDirection> list{{{0, 0, 1}, "0 degrees"}};
  const std::vector<double> angles =
      quick ? std::vector<double>{50, 89.9} : std::vector<double>{30, 60, 80, 89.9};
  const std::vector<double> longitudes = quick ? std::vector<double>{126} : std::vector<double>{20, 126, 250};
  constexpr double radians = std::numbers::pi / 180;
  for (const double angle : angles)
    for (const double longitude : longitudes)
      list.push_back({as_float(polar(angle * radians, longitude * radians)),
                      fmt::format("{:g} degrees, longitude {:g}", angle, longitude)});
  if (both_sides)
    for (std::size_t i = 0, above = list.size(); i < above; ++i)
      list.push_back({list[i].direction * Direction(1, 1, -1), list[i].name + ", on the back"});
  return list;
}

} // namespace phlux::verify
