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
  Digest() : state_(XXH3_createState(), XXH3_freeState) { XXH3_128bits_reset(state_.get()); }

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
  void add_one(const glm::vec3& v) { add(v.x, v.y, v.z); }
  void add_one(const std::array<std::uint32_t, 3>& corners) { add(corners[0], corners[1], corners[2]); }

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
    const auto& [region, origin, edge_u, edge_v, surface] = patch;
    add(region, origin, edge_u, edge_v, surface);
  }
  void add_one(const Sphere& sphere) {
    const auto& [center, radius, front_is_inside, surface] = sphere;
    add(center, radius, front_is_inside, surface);
  }
  void add_one(const Mesh& mesh) {
    const auto& [positions, normals, triangles, surface] = mesh;
    add(positions, normals, triangles, surface);
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
  void add_one(const Camera& camera) {
    const auto& [position, left, up, forward, tan_half_fov_x, principal_x, principal_y, width, height] =
        camera;
    add(position, left, up, forward, tan_half_fov_x, principal_x, principal_y);
  }

  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

} // namespace

std::string digest(const Scene& scene) {
  const auto& [materials, area_emitters, patches, spheres, meshes, point_lights, spot_lights,
               directional_lights, constant_radiance, strict_normals, camera, defaults] = scene;
  Digest result;
  result.add(materials, area_emitters, patches, spheres, meshes, point_lights, spot_lights,
             directional_lights, constant_radiance, strict_normals, camera);
  return result.text();
}

} // namespace phlux::scene
