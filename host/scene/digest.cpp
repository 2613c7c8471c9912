#include "scene/digest.h"

#include <array>
#include <bit>
#include <concepts>
#include <memory>

#include <fmt/format.h>
#include <xxhash.h>

namespace phlux::scene {
namespace {

// With structured bindings, a new member that is not added here is a compile error. Values have the same
// bytes on every machine; lists begin with their length.
class Digest {
public:
  explicit Digest(bool with_uv) : with_uv_(with_uv), state_(XXH3_createState(), XXH3_freeState) {
    XXH3_128bits_reset(state_.get());
  }

  template<class... Values>
  void add(const Values&... values) {
    (add_one(values), ...);
  }

  [[nodiscard]] std::string text() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
  }

private:
  void add_word(std::uint32_t word) {
    const std::array<unsigned char, 4> bytes = {
        static_cast<unsigned char>(word), static_cast<unsigned char>(word >> 8),
        static_cast<unsigned char>(word >> 16), static_cast<unsigned char>(word >> 24)};
    XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
  }

  template<std::integral Value>
  void add_one(Value value) {
    add_word(static_cast<std::uint32_t>(value));
  }
  template<class Value>
  requires std::is_enum_v<Value>
  void add_one(Value value) { add_word(static_cast<std::uint32_t>(value)); }
  void add_one(float value) { add_word(std::bit_cast<std::uint32_t>(value == 0.0F ? 0.0F : value)); }
  void add_one(double value) { add_one(static_cast<float>(value)); }
  void add_one(const std::string& text) {
    add_word(static_cast<std::uint32_t>(text.size()));
    XXH3_128bits_update(state_.get(), text.data(), text.size());
  }
  void add_one(const Vec3& v) { add(v.x, v.y, v.z); }
  void add_one(const glm::vec2& v) { add(v.x, v.y); }
  void add_one(const glm::dvec2& v) { add(v.x, v.y); }
  void add_one(const glm::vec3& v) { add(v.x, v.y, v.z); }
  void add_one(const std::array<std::uint32_t, 3>& corners) { add(corners[0], corners[1], corners[2]); }

  template<class Value, std::size_t size>
  void add_one(const std::array<Value, size>& values) {
    for (const Value& value : values) add_one(value);
  }
  template<class Value>
  void add_one(const std::vector<Value>& values) {
    add_word(static_cast<std::uint32_t>(values.size()));
    for (const Value& value : values) add_one(value);
  }
  template<class Value>
  void add_one(const std::optional<Value>& value) {
    add(value.has_value());
    if (value) add_one(*value);
  }

  void add_one(const Material& material) {
    add(material.model->name, material.model->text, material.values, material.two_sided);
    for (std::size_t i = 0; i < material.textures.size(); ++i)
      if (material.textures[i]) add(i, *material.textures[i]);
    if (material.is_masked()) add(material.opacity);
    if (material.opacity_texture) add(*material.opacity_texture);
  }
  void add_one(const Texture& texture) {
    const auto& [image, nearest, wrap_u, wrap_v, colors, to_uv, scale] = texture;
    add(nearest, wrap_u, wrap_v, colors, to_uv, scale, image != nullptr);
    if (image) add(*image);
  }
  void add_one(const TexelImage& image) {
    const auto& [width, height, bytes, decoded, floats, smallest, largest] = image;
    add(width, height, floats);
    if (!bytes.empty()) add(decoded);
    XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
  }
  void add_one(const Surface& surface) {
    const auto& [material, area_emitter] = surface;
    add(material, area_emitter);
  }
  void add_one(const AreaEmitter& emitter) {
    const auto& [radiance] = emitter;
    add(radiance);
  }
  void add_one(const Patch& patch) {
    const auto& [region, origin, edge_u, edge_v, surface, uv] = patch;
    add(region, origin, edge_u, edge_v, surface);
    if (with_uv_) add(uv);
  }
  void add_one(const Sphere& sphere) {
    const auto& [center, radius, front_is_inside, surface, axes] = sphere;
    add(center, radius, front_is_inside, surface);
    if (with_uv_) add(axes);
  }
  void add_one(const Mesh& mesh) {
    const auto& [positions, normals, triangles, surface, texture_coordinates] = mesh;
    add(positions, normals, triangles, surface);
    if (with_uv_) add(texture_coordinates);
  }
  void add_one(const PointLight& light) {
    const auto& [position, intensity] = light;
    add(position, intensity);
  }
  void add_one(const SpotLight& light) {
    const auto& [position, direction, intensity, cutoff_angle, beam_width] = light;
    add(position, direction, intensity, cutoff_angle, beam_width);
  }
  void add_one(const DirectionalLight& light) {
    const auto& [direction, irradiance] = light;
    add(direction, irradiance);
  }
  void add_one(const EnvironmentMap& map) {
    const auto& [width, height, texels, to_world, scale] = map;
    add(width, height, texels, to_world[0], to_world[1], to_world[2], scale);
  }
  void add_one(const Camera& camera) {
    const auto& [orthographic, position, left, up, forward, tan_half_fov_x, principal_x, principal_y,
                 aperture_radius, focus_distance, filter, width, height, origin, whole] = camera;
    add(orthographic, position, left, up, forward, tan_half_fov_x, principal_x, principal_y, aperture_radius,
        focus_distance, filter.kind, filter.size);
  }

  bool with_uv_; ///< only then can an image depend on texture coordinates
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

} // namespace

std::string digest(const Scene& scene) {
  const auto& [materials, area_emitters, patches, spheres, meshes, point_lights, spot_lights,
               directional_lights, constant_radiance, environment, strict_normals, hide_emitters, camera,
               defaults, files] = scene;
  Digest result(needs_uv(scene));
  result.add(materials, area_emitters, patches, spheres, meshes, point_lights, spot_lights,
             directional_lights, constant_radiance, environment, strict_normals, camera);
  if (hide_emitters) result.add(hide_emitters);
  return result.text();
}

} // namespace phlux::scene
