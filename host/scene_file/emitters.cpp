#include "scene_file/emitters.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>
#include <glm/trigonometric.hpp>

#include "scene_file/environment_map.h"
#include "scene_file/properties.h"
#include "scene_file/transform.h"

namespace phlux::scene_file {

namespace {

using scene::Rgb;
using scene::Vec3;

constexpr double default_cutoff_degrees = 20.0;
constexpr double default_beam_share = 0.75; ///< of the cutoff angle
/// Directions in single precision are off by up to 1e-5 degrees: by 1% of the narrowest cone.
constexpr double least_cutoff_degrees = 1e-3;

Rgb emission(Properties& properties, const std::string& name) {
  const Rgb color = properties.color(name, Rgb(1.0));
  if (glm::compMin(color) < 0.0)
    properties.fail_at(name, "negative emission", "every channel must be 0 or more");
  return color;
}

/// Whether the emitter is not black; warns if it is.
bool emits(const Properties& properties, const Rgb& color) {
  if (color != Rgb(0.0)) return true;
  properties.document().warnings->add(properties.element().where,
                                      properties.element().name() + " emits nothing and is left out");
  return false;
}

/// `position` or `direction`, which exclude to_world, as in Mitsuba.
std::optional<Vec3> explicit_place(Properties& properties, const std::string& name) {
  const auto place = properties.vector(name);
  if (place && properties.has("to_world"))
    properties.fail_at(name, "given together with " + properties.spelling("to_world"), "give one of the two");
  return place;
}

Vec3 axis(Properties& properties) {
  const glm::dmat4 to_world = properties.transform("to_world");
  if (!is_rigid(to_world))
    properties.fail_at("to_world", "it scales or shears", "translations, rotations and lookat alone");
  return glm::normalize(Vec3(to_world[2]));
}

void read_point(Properties& properties, scene::Scene& scene) {
  const auto position = explicit_place(properties, "position");
  const Vec3 origin(properties.transform("to_world")[3]);
  const scene::PointLight light{position.value_or(origin), emission(properties, "intensity")};
  if (emits(properties, light.intensity)) scene.point_lights.push_back(light);
}

void read_spot(Properties& properties, scene::Scene& scene) {
  scene::SpotLight light;
  light.position = Vec3(properties.transform("to_world")[3]);
  light.direction = axis(properties);
  light.intensity = emission(properties, "intensity");
  const double cutoff = properties.real("cutoff_angle", default_cutoff_degrees);
  const double beam = properties.real("beam_width", default_beam_share * cutoff);
  if (!(cutoff >= least_cutoff_degrees && cutoff <= 180.0))
    properties.fail_at("cutoff_angle", fmt::format("{:g} degrees", cutoff),
                       fmt::format("from {:g} to 180", least_cutoff_degrees));
  if (!(beam >= 0.0 && beam <= cutoff))
    properties.fail_at("beam_width", std::to_string(beam) + " degrees",
                       "0 or more, and at most the cutoff angle");
  light.cutoff_angle = glm::radians(cutoff);
  light.beam_width = glm::radians(beam);
  if (emits(properties, light.intensity)) scene.spot_lights.push_back(light);
}

void read_directional(Properties& properties, scene::Scene& scene) {
  scene::DirectionalLight light;
  const auto direction = explicit_place(properties, "direction");
  if (direction && *direction == Vec3(0.0))
    properties.fail_at("direction", "it has no length", "a vector along the light");
  light.direction =
      direction ? glm::normalize(*direction / glm::compMax(glm::abs(*direction))) : axis(properties);
  light.irradiance = emission(properties, "irradiance");
  if (emits(properties, light.irradiance)) scene.directional_lights.push_back(light);
}

/// As in Mitsuba, a scene has at most one.
void check_only_sky(const Properties& properties, const scene::Scene& scene) {
  if (scene.constant_radiance || scene.environment)
    fail(properties.element().where, "a second constant or envmap emitter", "give one, with their sum");
}

void read_constant(Properties& properties, scene::Scene& scene) {
  const Rgb radiance = emission(properties, "radiance");
  properties.pass_over({"to_world"});
  check_only_sky(properties, scene);
  if (emits(properties, radiance)) scene.constant_radiance = radiance;
}

void read_envmap(Properties& properties, scene::Scene& scene) {
  check_only_sky(properties, scene);
  scene::EnvironmentMap map = read_environment_map(properties);
  if (emits(properties, map.scale)) scene.environment = std::move(map);
}

} // namespace

void read_emitter(const Element& emitter, const Document& document, scene::Scene& scene) {
  Properties properties(emitter, document);
  properties.pass_over({"sampling_weight"});
  const std::string type = emitter.type();
  if (type == "point")
    read_point(properties, scene);
  else if (type == "spot")
    read_spot(properties, scene);
  else if (type == "directional")
    read_directional(properties, scene);
  else if (type == "constant")
    read_constant(properties, scene);
  else if (type == "envmap")
    read_envmap(properties, scene);
  else if (type == "sky" || type == "sun" || type == "sunsky")
    fail(emitter.where, emitter.name() + " is not supported",
         "render it alone in Mitsuba by a spherical sensor, and give the image to an envmap");
  else if (type == "area")
    fail(emitter.where, emitter.name() + " outside a shape", "it must stand inside the <shape> that emits");
  else
    fail(emitter.where, emitter.name() + " is not supported",
         "supported are area, point, spot, directional, constant, envmap");
  properties.finish();
}

scene::AreaEmitter read_area_emitter(const Element& emitter, const Document& document) {
  Properties properties(emitter, document);
  if (emitter.type() != "area") fail(emitter.where, emitter.name() + " inside a shape", "an area emitter");
  properties.pass_over({"sampling_weight"});
  const scene::AreaEmitter area{emission(properties, "radiance")};
  properties.finish();
  static_cast<void>(emits(properties, area.radiance));
  return area;
}

} // namespace phlux::scene_file
