#include "scene_file/sensor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene_file/properties.h"
#include "scene_file/transform.h"
#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

using scene::Vec3;

constexpr int largest_size = 32768;                       ///< pixels along one side of the image
const double film_35mm_diagonal = std::hypot(36.0, 24.0); ///< mm, to which Mitsuba's focal lengths refer

int positive(Properties& properties, const std::string& name, int otherwise, int most) {
  const int value = properties.integer(name, otherwise);
  if (value < 1 || value > most)
    properties.fail_at(name, std::to_string(value) + " is out of range", "1 to " + std::to_string(most));
  return value;
}

void read_filter(const Element& filter, const Document& document) {
  static const std::set<std::string> filters{"box", "tent", "gaussian", "mitchell", "catmullrom", "lanczos"};
  if (!filters.contains(filter.type()))
    fail(filter.where, filter.name() + " is not supported",
         "box, or another of Mitsuba's, for which box is used");
  if (filter.type() != "box") warn(filter.where, filter.name() + " is not supported; box is used");
  Properties(filter, document).pass_over_rest();
}

void read_film(const Element& film, const Document& document, scene::Camera& camera) {
  Properties properties(film, document);
  static const std::set<std::string> films{"hdrfilm", "ldrfilm", "mfilm", "tiledhdrfilm", "specfilm"};
  if (!films.contains(film.type()))
    fail(film.where, film.name() + " is not supported",
         "supported is hdrfilm; others of Mitsuba's become it");
  if (film.type() != "hdrfilm") note(film.where, film.name() + " is read as hdrfilm: linear radiance in EXR");
  camera.width = positive(properties, "width", camera.width, largest_size);
  camera.height = positive(properties, "height", camera.height, largest_size);
  for (const auto& [name, whole] :
       {std::pair{"crop_offset_x", 0}, std::pair{"crop_offset_y", 0}, std::pair{"crop_width", camera.width},
        std::pair{"crop_height", camera.height}})
    if (properties.integer(name, whole) != whole)
      properties.fail_at(name, "crop windows are not supported",
                         "leave the crop out to render the whole film");
  if (const Element* filter = properties.object("rfilter")) read_filter(*filter, document);
  properties.pass_over_rest();
  properties.finish();
}

void read_sampler(const Element& sampler, const Document& document, scene::RenderDefaults& defaults) {
  if (sampler.type() != "independent")
    warn(sampler.where, sampler.name() + " is not supported; independent is used");
  Properties properties(sampler, document);
  defaults.samples_per_pixel =
      positive(properties, "sample_count", defaults.samples_per_pixel, std::numeric_limits<int>::max());
  properties.pass_over_rest();
  properties.finish();
}

/// Tangent of half the horizontal field of view, from fov along fov_axis, or from focal_length.
double tan_half_fov_x(Properties& properties, double aspect) {
  const double tan_across_diagonal =
      1.0 / std::sqrt(1.0 + 1.0 / (aspect * aspect)); // horizontal over diagonal
  std::string axis = to_lower(properties.string("fov_axis", "x"));
  if (!properties.has("fov")) {
    std::string length = properties.string("focal_length", "50mm");
    if (length.ends_with("mm")) length.resize(length.size() - 2);
    const auto millimetres = parse_real(length);
    if (!millimetres || *millimetres <= 0.0)
      properties.fail_at("focal_length", "'" + length + "' is not a length",
                         "a positive number of mm, such as 50mm");
    return film_35mm_diagonal / (2.0 * *millimetres) * tan_across_diagonal;
  }
  if (properties.has("focal_length"))
    properties.fail_at("focal_length", "given together with fov", "give one of the two");
  const double degrees = properties.real("fov", 0.0);
  if (!(degrees > 0.0 && degrees < 180.0))
    properties.fail_at("fov", std::to_string(degrees) + " degrees", "more than 0 and less than 180");
  if (axis == "smaller") axis = aspect > 1.0 ? "y" : "x";
  if (axis == "larger") axis = aspect > 1.0 ? "x" : "y";
  const std::map<std::string, double> to_horizontal{
      {"x", 1.0}, {"y", aspect}, {"diagonal", tan_across_diagonal}};
  if (!to_horizontal.contains(axis))
    properties.fail_at("fov_axis", "'" + axis + "' is not an axis", "x, y, diagonal, smaller or larger");
  return std::tan(glm::radians(degrees) / 2.0) * to_horizontal.at(axis);
}

void place(Properties& properties, scene::Camera& camera) {
  const glm::dmat4 to_world = properties.transform("to_world");
  if (!is_rigid(to_world))
    properties.fail_at("to_world", "it scales or shears",
                       "translations, rotations, lookat and mirroring alone");
  camera.position = Vec3(to_world[3]);
  camera.forward = glm::normalize(Vec3(to_world[2]));
  camera.left =
      glm::normalize(Vec3(to_world[0]) - camera.forward * glm::dot(camera.forward, Vec3(to_world[0])));
  const Vec3 up = glm::cross(camera.forward, camera.left);
  camera.up = glm::dot(up, Vec3(to_world[1])) < 0.0 ? -up : up; // to_world may mirror
}

} // namespace

void read_sensor(const Element& sensor, const Document& document,
                 const std::optional<std::array<int, 2>>& size, scene::Scene& scene) {
  Properties properties(sensor, document);
  if (sensor.type() != "perspective")
    fail(sensor.where, sensor.name() + " is not supported", "supported is perspective");
  scene::Camera& camera = scene.camera;
  if (const Element* film = properties.object("film"))
    document.problems->attempt([&] { read_film(*film, document, camera); });
  if (size) {
    camera.width = (*size)[0];
    camera.height = (*size)[1];
  }
  if (const Element* sampler = properties.object("sampler"))
    document.problems->attempt([&] { read_sampler(*sampler, document, scene.defaults); });
  place(properties, camera);
  camera.tan_half_fov_x = tan_half_fov_x(properties, static_cast<double>(camera.width) / camera.height);
  camera.principal_x = properties.real("principal_point_offset_x", 0.0);
  camera.principal_y = properties.real("principal_point_offset_y", 0.0);
  properties.pass_over({"near_clip", "far_clip", "shutter_open", "shutter_close", "focus_distance"});
  properties.finish();
}

} // namespace phlux::scene_file
