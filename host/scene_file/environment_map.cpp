#include "scene_file/environment_map.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>

#include "scene_file/color.h"
#include "scene_file/image_file.h"
#include "scene_file/transform.h"

namespace phlux::scene_file {

namespace {

void set_texels(ImageFile image, scene::EnvironmentMap& map) {
  if (image.floats.empty())
    for (std::size_t i = 0; i < image.bytes.size(); ++i)
      if (i % 4 != 3) image.floats.push_back(static_cast<float>(image.bytes[i]) / 255);
  if (image.is_encoded)
    for (float& value : image.floats) value = static_cast<float>(decode_srgb(static_cast<double>(value)));
  map.width = image.width;
  map.height = image.height;
  map.texels.reserve(image.floats.size() / 3);
  for (std::size_t i = 0; i < image.floats.size(); i += 3)
    map.texels.emplace_back(image.floats[i], image.floats[i + 1], image.floats[i + 2]);
}

void check_positive(const std::filesystem::path& file, const Location& named_at,
                    const scene::EnvironmentMap& map) {
  const auto negative =
      std::ranges::find_if(map.texels, [](const glm::vec3& texel) { return glm::compMin(texel) < 0; });
  if (negative == map.texels.end()) return;
  const auto pixel = negative - map.texels.begin();
  fail_in_image(file, named_at,
                fmt::format("pixel ({}, {}) is negative", pixel % map.width, pixel / map.width),
                "radiance is 0 or more: clamp the image at 0");
}

} // namespace

scene::EnvironmentMap read_environment_map(Properties& properties) {
  scene::EnvironmentMap map;
  const std::string name = properties.string("filename", "");
  if (name.empty())
    fail(properties.element().where, properties.element().name() + " without a filename",
         "<string name=\"filename\" value=\"sky.exr\"/>");
  const std::filesystem::path file = properties.document().find(name);
  ImageFile image = read_image(file, properties.where("filename"));
  if (image.is_encoded && properties.has("gamma"))
    properties.fail_at("gamma", "only sRGB is decoded", "leave it out, or use an HDR or OpenEXR image");
  properties.pass_over({"gamma", "cache", "mis_compensation"});
  set_texels(std::move(image), map);
  check_positive(file, properties.where("filename"), map);

  map.scale = scene::Rgb(properties.real("scale", 1.0));
  if (map.scale.r < 0.0) properties.fail_at("scale", "negative emission", "0 or more");
  if (std::ranges::all_of(map.texels, [](const glm::vec3& texel) { return texel == glm::vec3(0); }))
    map.scale = scene::Rgb(0.0);
  const glm::dmat4 to_world = properties.transform("to_world");
  if (!is_similarity(to_world))
    properties.fail_at("to_world", "it shears or stretches", "rotations and mirroring");
  for (int axis = 0; axis < 3; ++axis) map.to_world[axis] = glm::normalize(glm::dvec3(to_world[axis]));
  return map;
}

} // namespace phlux::scene_file
