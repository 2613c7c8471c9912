// The contents of a scene, and the kernel and memory of its render.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/trigonometric.hpp>

#include "cli/info.h"
#include "cli/memory.h"
#include "cli/spelling.h"
#include "cli/table.h"
#include "errors.h"
#include "render/outline.h"
#include "scene/digest.h"

namespace phlux::cli {
namespace {

using nlohmann::ordered_json;

ordered_json numbers(const scene::Vec3& v) {
  return {v.x, v.y, v.z};
}

ordered_json settings_json(const scene::Scene& scene, const render::Settings& settings) {
  return {{"width", scene.camera.width},       {"height", scene.camera.height},
          {"integrator", settings.integrator}, {"samples_per_pixel", settings.samples_per_pixel},
          {"max_depth", settings.max_depth},   {"rr_depth", settings.rr_depth}};
}

ordered_json camera_json(const scene::Camera& camera) {
  const double across = camera.tan_half_fov_x, down = across * camera.height / camera.width;
  ordered_json json = {{"position", numbers(camera.position)},
                       {"forward", numbers(camera.forward)},
                       {"up", numbers(camera.up)}};
  if (camera.orthographic)
    json["film_size"] = {2 * across, 2 * down};
  else
    json["field_of_view"] = {glm::degrees(2 * std::atan(across)), glm::degrees(2 * std::atan(down))};
  if (camera.aperture_radius > 0) {
    json["aperture_radius"] = camera.aperture_radius;
    json["focus_distance"] = camera.focus_distance;
  }
  constexpr std::array filters = {"box", "tent", "gaussian"}; // of Filter::Kind
  json["filter"] = filters[static_cast<std::size_t>(camera.filter.kind)];
  return json;
}

ordered_json shapes_json(const scene::Scene& scene) {
  const auto ellipses =
      std::ranges::count(scene.patches, scene::Patch::Region::ellipse, &scene::Patch::region);
  std::size_t triangles = 0, vertices = 0;
  for (const scene::Mesh& mesh : scene.meshes) {
    triangles += mesh.triangles.size();
    vertices += mesh.positions.size();
  }
  return {{"parallelograms", scene.patches.size() - static_cast<std::size_t>(ellipses)},
          {"ellipses", ellipses},
          {"spheres", scene.spheres.size()},
          {"meshes", scene.meshes.size()},
          {"triangles", triangles},
          {"vertices", vertices}};
}

template<class Function>
void for_each_surface(const scene::Scene& scene, const Function& function) {
  for (const auto& shape : scene.patches) function(shape.surface);
  for (const auto& shape : scene.spheres) function(shape.surface);
  for (const auto& shape : scene.meshes) function(shape.surface);
}

ordered_json color_json(const scene::Rgb& color, const scene::TexturePointer& texture) {
  if (!texture) return numbers(color);
  if (!texture->image) return "checkerboard";
  return fmt::format("bitmap {}x{}", texture->image->width, texture->image->height);
}

ordered_json materials_json(const scene::Scene& scene) {
  std::vector<std::size_t> shapes(scene.materials.size());
  for_each_surface(
      scene, [&](const scene::Surface& surface) { ++shapes[static_cast<std::size_t>(surface.material)]; });
  auto list = ordered_json::array();
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const scene::Material& material = scene.materials[i];
    ordered_json parameters = ordered_json::object();
    for (std::size_t p = 0; p < material.values.size(); ++p) {
      const scene::Parameter& parameter = material.model->parameters[p];
      parameters[parameter.name] = parameter.kind == scene::Parameter::Kind::colour
                                       ? color_json(material.values[p], material.texture(p))
                                       : ordered_json(material.values[p].x);
    }
    if (material.is_masked()) parameters["opacity"] = color_json(material.opacity, material.opacity_texture);
    list.push_back({{"model", material.model->name},
                    {"parameters", parameters},
                    {"two_sided", material.two_sided},
                    {"shapes", shapes[i]}});
  }
  return list;
}

ordered_json lights_json(const scene::Scene& scene) {
  auto list = ordered_json::array();
  std::vector<std::size_t> shapes(scene.area_emitters.size()); // one per emitter, but six for a cube
  for_each_surface(scene, [&](const scene::Surface& surface) {
    if (surface.area_emitter >= 0) ++shapes[static_cast<std::size_t>(surface.area_emitter)];
  });
  for (std::size_t i = 0; i < shapes.size(); ++i)
    list.push_back(
        {{"type", "area"}, {"radiance", numbers(scene.area_emitters[i].radiance)}, {"shapes", shapes[i]}});
  for (const scene::PointLight& light : scene.point_lights)
    list.push_back(
        {{"type", "point"}, {"intensity", numbers(light.intensity)}, {"position", numbers(light.position)}});
  for (const scene::SpotLight& light : scene.spot_lights)
    list.push_back({{"type", "spot"},
                    {"intensity", numbers(light.intensity)},
                    {"position", numbers(light.position)},
                    {"direction", numbers(light.direction)},
                    {"cutoff_angle", glm::degrees(light.cutoff_angle)}});
  for (const scene::DirectionalLight& light : scene.directional_lights)
    list.push_back({{"type", "directional"},
                    {"irradiance", numbers(light.irradiance)},
                    {"direction", numbers(light.direction)}});
  if (scene.constant_radiance)
    list.push_back({{"type", "constant"}, {"radiance", numbers(*scene.constant_radiance)}});
  if (scene.environment)
    list.push_back({{"type", "envmap"},
                    {"width", scene.environment->width},
                    {"height", scene.environment->height},
                    {"scale", numbers(scene.environment->scale)}});
  return list;
}

// The memory of meshes, textures and the environment map on the host.
std::size_t data_bytes(const scene::Scene& scene) {
  std::size_t bytes = 0;
  const auto add = [&](const auto& values) { bytes += values.size() * sizeof(values[0]); };
  for (const scene::Mesh& mesh : scene.meshes) {
    add(mesh.positions);
    add(mesh.normals);
    add(mesh.texture_coordinates);
    add(mesh.triangles);
  }
  std::set<const scene::TexelImage*> images;
  const auto add_texture = [&](const scene::TexturePointer& texture) {
    if (!texture || !texture->image || !images.insert(texture->image.get()).second) return;
    add(texture->image->bytes);
    add(texture->image->floats);
  };
  for (const scene::Material& material : scene.materials) {
    std::ranges::for_each(material.textures, add_texture);
    add_texture(material.opacity_texture);
  }
  if (scene.environment) add(scene.environment->texels);
  return bytes;
}

void add_outline(const render::Outline& outline, ordered_json& json) {
  const render::Parts& parts = outline.parts;
  json["device"] = outline.device.name;
  json["kernel"] = {{"name", settings::info_of(parts.integrator).kernel},
                    {"width", parts.lanes},
                    {"traversal", parts.hierarchy ? "bvh" : "brute"},
                    {"primitives", outline.primitives},
                    {"parts", parts.names()}};
  json["memory"]["device"] = outline.table_bytes;
}

std::string text_of(const ordered_json& value) {
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::vector<std::string> texts;
  for (const ordered_json& element : value) texts.push_back(text_of(element));
  return fmt::format("{}", fmt::join(texts, " "));
}

std::string memory_text(const ordered_json& bytes) {
  const double size = bytes.get<double>();
  if (size < 1e6) return fmt::format("{:.3g} kB", 1e-3 * size);
  return size < 1e9 ? fmt::format("{:.3g} MB", 1e-6 * size) : fmt::format("{:.3g} GB", 1e-9 * size);
}

std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string singular(const std::string& plural) {
  return plural == "meshes" ? "mesh" : plural.substr(0, plural.size() - 1);
}

// "name value, name value", without entries that are 0.
std::string list_text(const ordered_json& object) {
  std::vector<std::string> texts;
  for (const auto& [name, value] : object.items())
    if (value != 0) texts.push_back(fmt::format("{} {}", text_of(value), value == 1 ? singular(name) : name));
  return texts.empty() ? "none" : fmt::format("{}", fmt::join(texts, ", "));
}

// "name value, name value".
std::string pairs_text(const ordered_json& object) {
  std::vector<std::string> texts;
  for (const auto& [name, value] : object.items())
    if (name != "type") texts.push_back(fmt::format("{} {}", name, text_of(value)));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string material_text(const ordered_json& material) {
  std::string text = material["model"].get<std::string>() + ":";
  for (const auto& [name, value] : material["parameters"].items()) {
    const bool grey = value.is_array() && value[0] == value[1] && value[1] == value[2];
    text += fmt::format(" {} {},", name, text_of(grey ? value[0] : value));
  }
  return text + (material["two_sided"].get<bool>() ? " two-sided, on " : " on ") +
         counted(material["shapes"].get<std::size_t>(), "shape");
}

} // namespace

ordered_json scene_json(const std::string& file, const scene::Scene& scene,
                        const render::Settings& settings) {
  Outputs outputs;
  outputs.preview = "preview";
  ordered_json json = {
      {"scene", file},
      {"digest", scene::digest(scene)},
      {"render", settings_json(scene, settings)},
      {"camera", camera_json(scene.camera)},
      {"shapes", shapes_json(scene)},
      {"materials", materials_json(scene)},
      {"lights", lights_json(scene)},
      {"memory",
       {{"scene", data_bytes(scene)},
        {"image",
         memory_needed(static_cast<double>(scene.camera.width) * scene.camera.height, settings, outputs)
             .memory}}},
      {"device", nullptr},
      {"kernel", nullptr}};
  try {
    add_outline(render::outline(scene, settings), json);
  } catch (const DeviceError& error) {
    json["no_device"] = with_options(error.what());
  }
  return json;
}

std::string scene_text(const ordered_json& scene) {
  const ordered_json& memory = scene["memory"];
  std::vector<std::vector<std::string>> rows = {{"scene", text_of(scene["scene"])},
                                                {"render", pairs_text(scene["render"])},
                                                {"camera", pairs_text(scene["camera"])},
                                                {"shapes", list_text(scene["shapes"])}};
  for (const ordered_json& material : scene["materials"])
    rows.push_back({"material", material_text(material)});
  for (const ordered_json& light : scene["lights"])
    rows.push_back({"light", fmt::format("{}: {}", text_of(light["type"]), pairs_text(light))});
  if (scene["lights"].empty()) rows.push_back({"light", "none"});
  rows.push_back({"memory", fmt::format("{} for meshes and textures, {} for the image",
                                        memory_text(memory["scene"]), memory_text(memory["image"]))});
  if (scene["kernel"].is_null()) {
    rows.push_back({"device", "none: " + text_of(scene["no_device"])});
  } else {
    const ordered_json& kernel = scene["kernel"];
    rows.push_back({"device", fmt::format("{}, {} for the scene's tables", text_of(scene["device"]),
                                          memory_text(memory["device"]))});
    rows.push_back({"kernel", fmt::format("{}, --width {}, --traversal {} of {} primitives",
                                          text_of(kernel["name"]), text_of(kernel["width"]),
                                          text_of(kernel["traversal"]), text_of(kernel["primitives"]))});
    rows.push_back({"parts", text_of(kernel["parts"])});
  }
  return table_text(rows);
}

} // namespace phlux::cli
