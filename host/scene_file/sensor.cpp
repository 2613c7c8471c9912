#include "scene_file/sensor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene/image_size.h"
#include "scene_file/properties.h"
#include "scene_file/transform.h"
#include "scene_file/values.h"
#include "settings/values.h"

namespace phlux::scene_file {

namespace {

using scene::Vec3;

constexpr int largest_filter = 1000;                      ///< pixels
const double film_35mm_diagonal = std::hypot(36.0, 24.0); ///< mm, to which Mitsuba's focal lengths refer

int positive(Properties& properties, const std::string& name, int otherwise, int most) {
  const int value = properties.integer(name, otherwise);
  if (value < 1 || value > most)
    properties.fail_at(name, std::to_string(value) + " is out of range", "1 to " + std::to_string(most));
  return value;
}

double positive_size(Properties& properties, const std::string& name, double otherwise) {
  const double size = properties.real(name, otherwise);
  if (!(size > 0.0 && size <= largest_filter))
    properties.fail_at(name, std::to_string(size) + " pixels",
                       "more than 0 and at most " + std::to_string(largest_filter));
  return size;
}

/// The filters with negative lobes cannot be sampled. The box is the nearest to them that can: the variance
/// of mitchell is 1/9 of a pixel squared, that of the others about 0, that of the box 1/12, of the default
/// gaussian 1/4.
scene::Filter read_filter(const Element& element, const Document& document) {
  static const std::set<std::string> negative{"mitchell", "catmullrom", "lanczos"};
  Properties properties(element, document);
  scene::Filter filter;
  if (element.type() == "gaussian") {
    filter = {scene::Filter::Kind::gaussian, positive_size(properties, "stddev", 0.5)};
  } else if (element.type() == "tent") {
    filter = {scene::Filter::Kind::tent, positive_size(properties, "radius", 1.0)};
  } else if (element.type() == "box") {
    if (properties.real("radius", filter.size) != filter.size)
      properties.fail_at("radius", "the box filter is one pixel wide",
                         "leave it out, or use tent or gaussian");
  } else if (negative.contains(element.type())) {
    document.warnings->add(element.where,
                           element.name() + " has negative lobes, which cannot be sampled; box is used");
    properties.pass_over_rest();
  } else {
    fail(element.where, element.name() + " is not supported", "supported are box, tent and gaussian");
  }
  properties.finish();
  return filter;
}

/// Mitsuba's crop window, if it is a part of the film.
std::optional<scene::Window> read_crop(Properties& properties, const scene::Camera& camera) {
  const scene::Window whole{0, 0, camera.width, camera.height};
  const scene::Window crop{properties.integer("crop_offset_x", 0), properties.integer("crop_offset_y", 0),
                           properties.integer("crop_width", camera.width),
                           properties.integer("crop_height", camera.height)};
  if (!is_within(crop, camera))
    properties.fail_at(properties.has("crop_width") ? "crop_width" : "crop_offset_x",
                       "the crop window is not within the film",
                       properties.spelling("crop_offset_x") + " + " + properties.spelling("crop_width") +
                           " and " + properties.spelling("crop_offset_y") + " + " +
                           properties.spelling("crop_height") + " must be at most " +
                           std::to_string(camera.width) + " and " + std::to_string(camera.height));
  return crop == whole ? std::nullopt : std::optional(crop);
}

/// The same part of an image of another size, to whole pixels.
scene::Window scaled(const scene::Window& window, const scene::Camera& from, const std::array<int, 2>& to) {
  const auto scale = [](int edge, int old_size, int new_size) {
    return static_cast<int>(std::lround(static_cast<double>(edge) * new_size / old_size));
  };
  scene::Window result{scale(window.x, from.width, to[0]), scale(window.y, from.height, to[1]), 0, 0};
  result.width = std::max(1, scale(window.x + window.width, from.width, to[0]) - result.x);
  result.height = std::max(1, scale(window.y + window.height, from.height, to[1]) - result.y);
  result.x = std::min(result.x, to[0] - result.width);
  result.y = std::min(result.y, to[1] - result.height);
  return result;
}

void read_film(const Element& film, const Document& document, scene::Scene& scene) {
  scene::Camera& camera = scene.camera;
  Properties properties(film, document);
  static const std::set<std::string> films{"hdrfilm", "ldrfilm", "mfilm", "tiledhdrfilm", "specfilm"};
  if (!films.contains(film.type()))
    fail(film.where, film.name() + " is not supported",
         "supported is hdrfilm; others of Mitsuba's become it");
  if (film.type() != "hdrfilm") note(film.where, film.name() + " is read as hdrfilm: linear radiance in EXR");
  camera.width = positive(properties, "width", camera.width, settings::longest_side);
  camera.height = positive(properties, "height", camera.height, settings::longest_side);
  scene.defaults.crop = read_crop(properties, camera);
  if (const Element* filter = properties.object("rfilter")) camera.filter = read_filter(*filter, document);
  properties.pass_over({"file_format", "pixel_format", "component_format", "banner", "attach_log",
                        "high_quality_edges", "sample_border", "compensate", "gamma", "exposure", "key",
                        "burn", "tonemap_method", "digits", "variable"});
  properties.pass_over_rest();
  properties.finish();
}

void read_sampler(const Element& sampler, const Document& document, scene::RenderDefaults& defaults) {
  if (sampler.type() != "independent")
    document.warnings->add(sampler.where, sampler.name() + " is not supported; independent is used");
  Properties properties(sampler, document);
  defaults.samples_per_pixel =
      positive(properties, "sample_count", defaults.samples_per_pixel, std::numeric_limits<int>::max());
  properties.pass_over({"seed", "dimension", "scramble", "jitter"});
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
  if (!camera.orthographic && !is_rigid(to_world))
    properties.fail_at("to_world", "it scales or shears",
                       "translations, rotations, lookat and mirroring alone");
  const Vec3 left(to_world[0]), up(to_world[1]);
  camera.position = Vec3(to_world[3]);
  camera.forward = glm::normalize(Vec3(to_world[2]));
  camera.left = glm::normalize(left - camera.forward * glm::dot(camera.forward, left));
  camera.up = glm::cross(camera.forward, camera.left);
  if (glm::dot(camera.up, up) < 0.0) camera.up = -camera.up; // to_world may mirror
  if (!camera.orthographic) return;
  // The film's width is that of [-1, 1] in the camera's frame.
  camera.tan_half_fov_x = glm::length(left);
  const double error = 1e-4 * camera.tan_half_fov_x;
  if (glm::length(left - camera.left * camera.tan_half_fov_x) > error ||
      glm::length(up - camera.up * camera.tan_half_fov_x) > error)
    properties.fail_at("to_world", "it shears, or scales x and y differently",
                       "the same scale for both, across the direction of view");
}

void read_lens(Properties& properties, scene::Camera& camera) {
  camera.aperture_radius = properties.real("aperture_radius", -1.0);
  if (camera.aperture_radius < 0.0)
    properties.fail_at("aperture_radius",
                       properties.has("aperture_radius") ? "it is negative" : "it is missing",
                       "the radius of the lens, 0 or more");
  // Mitsuba's default is the far clipping distance.
  const bool given = properties.has("focus_distance");
  camera.focus_distance = given ? properties.real("focus_distance", 0.0) : properties.real("far_clip", 1e4);
  if (given) properties.pass_over({"far_clip"});
  if (camera.focus_distance <= 0.0)
    properties.fail_at("focus_distance", "it is not positive", "the distance of the plane that is in focus");
}

void read_field_of_view(Properties& properties, scene::Camera& camera) {
  camera.tan_half_fov_x = tan_half_fov_x(properties, static_cast<double>(camera.width) / camera.height);
  camera.principal_x = properties.real("principal_point_offset_x", 0.0);
  camera.principal_y = properties.real("principal_point_offset_y", 0.0);
}

} // namespace

void read_sensor(const Element& sensor, const Document& document,
                 const std::optional<std::array<int, 2>>& size, scene::Scene& scene) {
  Properties properties(sensor, document);
  if (sensor.type() != "perspective" && sensor.type() != "thinlens" && sensor.type() != "orthographic")
    fail(sensor.where, sensor.name() + " is not supported",
         "supported are perspective, thinlens and orthographic");
  scene::Camera& camera = scene.camera;
  camera.orthographic = sensor.type() == "orthographic";
  if (const Element* film = properties.object("film"))
    document.problems->attempt([&] { read_film(*film, document, scene); });
  if (!size && !settings::is_image_size(camera.width, camera.height))
    document.problems->attempt([&] {
      fail(properties.object("film")->where,
           fmt::format("a film of {}x{} pixels", camera.width, camera.height), settings::image_sizes());
    });
  if (size) {
    if (scene.defaults.crop) scene.defaults.crop = scaled(*scene.defaults.crop, camera, *size);
    camera.width = (*size)[0];
    camera.height = (*size)[1];
  }
  if (const Element* sampler = properties.object("sampler"))
    document.problems->attempt([&] { read_sampler(*sampler, document, scene.defaults); });
  place(properties, camera);
  if (!camera.orthographic) read_field_of_view(properties, camera);
  if (sensor.type() == "thinlens")
    read_lens(properties, camera);
  else
    properties.pass_over({"far_clip", "focus_distance"});
  properties.pass_over({"near_clip", "shutter_open", "shutter_close"});
  properties.finish();
}

} // namespace phlux::scene_file
