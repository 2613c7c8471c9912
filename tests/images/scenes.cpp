#include "images/scenes.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <spdlog/spdlog.h>

#include "scene_file/load.h"
#include "temporary_folder.h"
#include "tested_kernels.h"

namespace phlux::test {

using scene::Rgb;
using scene::Vec3;

const std::vector<std::string>& shipped_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(PHLUX_SOURCE_DIR "/scenes"))
      if (entry.path().extension() == ".xml") found.push_back(entry.path().stem());
    std::sort(found.begin(), found.end());
    return found;
  }();
  return names;
}

scene::Scene shipped(const std::string& name, int width, int height) {
  return scene_file::load(std::filesystem::path(PHLUX_SOURCE_DIR "/scenes") / (name + ".xml"),
                          {{"width", std::to_string(width)}, {"height", std::to_string(height)}});
}

scene::Scene from_xml(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("scene.xml", text);
  return scene_file::load(folder / "scene.xml");
}

scene::Camera look_at(const Vec3& origin, const Vec3& target, double fov_degrees, int width, int height) {
  scene::Camera camera;
  camera.position = origin;
  camera.forward = glm::normalize(target - origin);
  const Vec3 up = std::abs(camera.forward.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
  camera.left = glm::normalize(glm::cross(up, camera.forward));
  camera.up = glm::cross(camera.forward, camera.left);
  camera.tan_half_fov_x = std::tan(fov_degrees * std::numbers::pi / 360);
  camera.width = width;
  camera.height = height;
  return camera;
}

Vec3 direction_through(const scene::Camera& camera, double x, double y) {
  const double tangent = camera.tan_half_fov_x, aspect = static_cast<double>(camera.height) / camera.width;
  return glm::normalize(camera.forward + (1 - 2 * x / camera.width) * tangent * camera.left +
                        (1 - 2 * y / camera.height) * tangent * aspect * camera.up);
}

Estimate expected(const scene::Camera& camera, const std::function<Channels(const Vec3&)>& radiance,
                  int points) {
  std::vector<Channels> means;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      Channels sum{};
      for (int i = 0; i < points * points; ++i) {
        const double u = x + (i % points + 0.5) / points, v = y + (i / points + 0.5) / points;
        const Channels one = radiance(direction_through(camera, u, v));
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += one[c] / (points * points);
      }
      means.push_back(sum);
    }
  return closed_form(camera.width, camera.height, std::move(means));
}

scene::Patch square(const Vec3& center, const Vec3& edge_u, const Vec3& edge_v, double half,
                    scene::Surface surface) {
  return {scene::Patch::Region::parallelogram, center, half * edge_u, half * edge_v, surface};
}

scene::Mesh smooth_ball(const Vec3& center, double radius, int material) {
  scene::Mesh mesh;
  for (const Vec3& p :
       {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
    mesh.positions.push_back(center + radius * p);
    mesh.normals.emplace_back(p);
  }
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  mesh.surface = {material, -1};
  return mesh;
}

scene::Scene placed(scene::Scene scene, double scale, const Vec3& offset) {
  const auto place = [&](Vec3& position) { position = scale * position + offset; };
  for (scene::Patch& patch : scene.patches) {
    place(patch.origin);
    patch.edge_u *= scale;
    patch.edge_v *= scale;
  }
  for (scene::Sphere& sphere : scene.spheres) {
    place(sphere.center);
    sphere.radius *= scale;
  }
  for (scene::Mesh& mesh : scene.meshes)
    for (Vec3& position : mesh.positions) place(position);
  for (scene::PointLight& light : scene.point_lights) {
    place(light.position);
    light.intensity *= scale * scale;
  }
  for (scene::SpotLight& light : scene.spot_lights) {
    place(light.position);
    light.intensity *= scale * scale;
  }
  place(scene.camera.position);
  return scene;
}

bool is_black(const film::Film& film) {
  for (std::size_t i = 0; i < film.pixels().size(); ++i)
    if (film.mean(i) != Channels{}) return false;
  return true;
}

render::Settings settings_for(int samples, int max_depth) {
  render::Settings result;
  result.samples_per_pixel = samples;
  result.max_depth = max_depth;
  result.kernel_dir = tested_kernels();
  return result;
}

Render render_of(const scene::Scene& scene, const render::Settings& settings) {
  film::Film film(scene.camera.width, scene.camera.height);
  render::Statistics statistics = render::render(scene, settings, film, {});
  return {std::move(film), std::move(statistics)};
}

} // namespace phlux::test
