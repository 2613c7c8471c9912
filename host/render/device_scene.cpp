#include "render/device_scene.h"

#include <vector>

#include <fmt/format.h>

#include "device/buffer.h"
#include "errors.h"

namespace phlux::render {
namespace {

void check_room(const device::Device& device, std::size_t bytes, const char* what, const char* smaller) {
  if (bytes > device.info.largest_buffer)
    throw DeviceError(
        fmt::format("{}: the scene's {} take {} MB and a buffer may have {} MB: use a device with more "
                    "memory or {}",
                    device.info.name, what, bytes >> 20, device.info.largest_buffer >> 20, smaller));
}

[[noreturn]] void fail_for_room(const device::Device& device, std::size_t bytes, const char* what,
                                const cl::Error& error) {
  throw DeviceError(fmt::format("{}: no room for the scene's {} ({} MB): {}", device.info.name, what,
                                bytes >> 20, device::error_name(error.err())));
}

// Copies a table of entries of `elements_per_entry` elements. Kernels may load the first few_entries without
// checking the table's length, so that shorter tables are padded with zeros.
template<typename T>
cl::Buffer upload(const device::Device& device, const std::vector<T>& table, const char* what,
                  std::size_t elements_per_entry = 1) {
  const std::size_t least = few_entries * elements_per_entry;
  if (table.size() < least) {
    std::vector<T> longer = table;
    longer.resize(least);
    return upload(device, longer, what, elements_per_entry);
  }
  const std::size_t bytes = table.size() * sizeof(T);
  check_room(device, bytes, what, "a smaller mesh");
  try {
    return device::make_buffer(device, CL_MEM_READ_ONLY, bytes, table.data());
  } catch (const cl::Error& error) {
    fail_for_room(device, bytes, what, error);
  }
}

// Copies the images from where they are: together they may be as large as the host's memory.
cl::Buffer upload_texels(const device::Device& device, const tables::TextureTable& table) {
  if (table.words == 0) return upload(device, std::vector<float>(), "textures");
  const std::size_t bytes = table.words * sizeof(float);
  check_room(device, bytes, "textures", "smaller images");
  try {
    const cl::Buffer buffer = device::make_buffer(device, CL_MEM_READ_ONLY, bytes);
    for (const auto& piece : table.pieces)
      device.queue.enqueueWriteBuffer(buffer, CL_TRUE, piece.first_word * sizeof(float), piece.bytes.size(),
                                      piece.bytes.data());
    return buffer;
  } catch (const cl::Error& error) {
    fail_for_room(device, bytes, "textures", error);
  }
}

} // namespace

DeviceScene::DeviceScene(const device::Device& device, const HostScene& scene, const Parts& parts) {
  const auto table = [&](const char* name, const auto& values, const char* what, std::size_t elements = 1) {
    arguments_.emplace_back(name, upload(device, values, what, elements));
  };
  const auto number = [&](const char* name, auto value) { arguments_.emplace_back(name, value); };
  const accel::Geometry& geometry = *scene.geometry;
  table("camera", std::vector<CameraRecord>{scene.camera}, "camera");
  table("primitives", geometry.primitives, "primitives");
  table("materials", scene.materials.records, "materials",
        scene.materials.records.size() / scene.materials.count);
  table("lobe_tables", scene.materials.tables, "reflectivities");
  table("lights", scene.lights.records, "lights");
  number("light_count", static_cast<cl_int>(scene.lights.records.size()));
  table("light_nodes", scene.lights.nodes, "tree of lights");
  table("environment", std::vector<EnvironmentRecord>{scene.lights.environment.record}, "environment map");
  table("environment_texels", scene.lights.environment.texels, "environment map");
  number("light_tree_probability", static_cast<cl_float>(scene.lights.tree_probability));
  if (parts.double_precision) {
    table("planars", geometry.double_planars, "triangles", PLANAR_FLOATS);
    table("spheres", geometry.double_spheres, "spheres", SPHERE_FLOATS);
  } else {
    table("planars", geometry.planars, "triangles", PLANAR_FLOATS);
    table("spheres", geometry.spheres, "spheres", SPHERE_FLOATS);
  }
  number("triangle_end", cl_int{geometry.triangle_end});
  number("parallelogram_end", cl_int{geometry.parallelogram_end});
  number("ellipse_end", cl_int{geometry.ellipse_end});
  number("first_sphere", cl_int{geometry.first_sphere});
  number("sphere_count", cl_int{geometry.sphere_count});
  table("corners", geometry.corners, "triangles' corners");
  table("vertex_normals", geometry.vertex_normals, "vertex normals");
  table("uv_maps", geometry.uv_maps, "texture coordinates");
  table("texture_numbers", scene.materials.texture_numbers, "materials");
  table("textures", scene.textures.records, "textures");
  arguments_.emplace_back("texels", upload_texels(device, scene.textures));
  table("nodes", geometry.nodes, "hierarchy");
  number("root", cl_int{geometry.root});
}

void DeviceScene::bind(device::Kernel& kernel) const {
  for (const auto& argument : arguments_)
    std::visit([&](const auto& of) { kernel.set(argument.first, of); }, argument.second);
}

std::size_t DeviceScene::bytes() const {
  std::size_t sum = 0;
  for (const auto& [name, value] : arguments_)
    if (const auto* buffer = std::get_if<cl::Buffer>(&value)) sum += buffer->getInfo<CL_MEM_SIZE>();
  return sum;
}

} // namespace phlux::render
