// The camera: its rays, and the pixel and density of a direction.
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "directions.h"
#include "scene_test.h"

using namespace device_test;
using glm::dvec3;
using phlux::scene::Camera;
using phlux::scene::Scene;

namespace {

struct Film {
  int width, height;
  double tan_half_fov_x, principal_x, principal_y;
};
constexpr Film films[] = {{1, 1, 0.5, 0, 0},         {16, 16, 1, 0, 0},       {37, 11, 2.5, 0.3, -0.2},
                          {3, 300, 0.01, -0.7, 0.1}, {640, 480, 0.4, 0, 1.5}, {1024, 768, 0.7, 0, 0}};

Scene scene_of(const Film& film) {
  Scene scene;
  scene.materials.push_back(phlux::lobes::diffuse(phlux::scene::Rgb(0.5)));
  scene.spheres.push_back({});
  Camera& camera = scene.camera;
  camera.forward = glm::normalize(dvec3(1, -2, 0.5));
  camera.left = glm::normalize(glm::cross(dvec3(0, 1, 0), camera.forward));
  camera.up = glm::cross(camera.forward, camera.left);
  camera.position = {3, 4, -5};
  camera.width = film.width;
  camera.height = film.height;
  camera.tan_half_fov_x = film.tan_half_fov_x;
  camera.principal_x = film.principal_x;
  camera.principal_y = film.principal_y;
  return scene;
}

SceneProgram program_for(Variant v, const Scene& scene) {
  phlux::render::Settings settings;
  settings.integrator = "bidir"; // the only one that uses the density of the film
  settings.traversal = phlux::render::Traversal::brute_force;
  Scene lit = scene;
  lit.constant_radiance = dvec3(1);
  return {v, "camera.cl", lit, settings};
}

// The direction through a point of the image plane; [0, 1]^2 is the film.
dvec3 through(const Camera& camera, double x, double y) {
  const double across = camera.tan_half_fov_x, aspect = static_cast<double>(camera.height) / camera.width;
  return glm::normalize(camera.forward + (1 - 2 * (x + camera.principal_x)) * across * camera.left +
                        (1 - 2 * (y + camera.principal_y)) * across * aspect * camera.up);
}

double film_area(const Camera& camera) {
  const double across = 2 * camera.tan_half_fov_x;
  return across * across * camera.height / camera.width;
}

struct Seen {
  std::vector<int> seen, pixel;
  std::vector<float> density;
  explicit Seen(std::size_t count) : seen(count), pixel(count), density(count) {}
};

Seen see(const SceneProgram& program, const std::vector<dvec3>& directions) {
  std::vector<Float3> given;
  for (const dvec3& d : directions) given.push_back(to_float(d));
  Seen s(given.size());
  program.run("see_directions", given.size(), given, out(s.seen), out(s.pixel), out(s.density));
  return s;
}

} // namespace

TEST_CASE("camera: each pixel sees its own rays, up to its borders") {
  for (const Variant v : variants)
    for (const Film& film : std::span(films).first(thinned(std::size(films), 3))) {
      CAPTURE(v, film.width, film.height);
      const Scene scene = scene_of(film);
      const SceneProgram program = program_for(v, scene);
      const auto pixels = static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height);
      Random random(81);
      std::vector<std::uint32_t> pixel;
      std::vector<float> us, vs;
      // Positions on the film have errors of a few units in the last place: less than this part of a pixel.
      const float margin = 4e-6f * static_cast<float>(std::max(film.width, film.height));
      const std::size_t step = pixels > 5000 || thinned(pixels) < pixels ? 61 : 1;
      for (std::size_t i = 0; i < pixels; i += step)
        for (int place = 0; place < 5; ++place) {
          pixel.push_back(static_cast<std::uint32_t>(i));
          const auto coordinate = [&](int border) {
            return place == 4    ? static_cast<float>(random.uniform(margin, 1 - margin))
                   : border == 0 ? margin
                                 : 1 - margin;
          };
          us.push_back(coordinate(place & 1));
          vs.push_back(coordinate(place >> 1));
        }
      const std::size_t count = pixel.size();
      std::vector<Float3> direction(count);
      std::vector<int> seen(count), seen_pixel(count);
      std::vector<float> density(count), density_alone(count);
      program.run("see_rays", count, pixel, us, vs, out(direction), out(seen), out(seen_pixel), out(density),
                  out(density_alone));
      for (std::size_t i = 0; i < count; ++i) {
        CAPTURE(i, pixel[i], us[i], vs[i]);
        const int column = static_cast<int>(pixel[i]) % film.width,
                  row = static_cast<int>(pixel[i]) / film.width;
        const double x = (column + double(us[i])) / film.width, y = (row + double(vs[i])) / film.height;
        const dvec3 right = through(scene.camera, x, y);
        REQUIRE(glm::length(to_double(direction[i]) - right) < 1e-6);
        REQUIRE(seen[i] == 1);
        REQUIRE(seen_pixel[i] == static_cast<int>(pixel[i]));
        const double cosine = glm::dot(right, scene.camera.forward);
        REQUIRE(density[i] * film_area(scene.camera) * cosine * cosine * cosine == Approx(1).epsilon(1e-5));
        REQUIRE(density_alone[i] == Approx(density[i]).epsilon(1e-6));
      }
    }
}

TEST_CASE("camera: the rays of a pixel are within the bounds of its packet, which are tight") {
  struct Bounds {
    Float3 origin, direction, across, down, fast_inverse, slow_inverse;
    int same_signs;
  };
  // The second camera is rolled by 45 degrees. The x of directions near a diagonal of its film is a small
  // difference of large terms.
  for (const Variant v : variants)
    for (const bool rolled : {false, true})
      for (const Film& film : films) {
        CAPTURE(v, rolled, film.width, film.height);
        Scene scene = scene_of(film);
        phlux::scene::Camera& camera = scene.camera;
        if (rolled) {
          camera.forward = {0, 0, 1};
          camera.left = glm::normalize(dvec3(1, 1, 0));
          camera.up = glm::normalize(dvec3(-1, 1, 0));
        }
        const SceneProgram program = program_for(v, scene);
        const dvec3 origin = camera.position - program.host().geometry->origin;
        Random random(82);
        std::vector<int> pixel, counts;
        std::vector<float> us, vs;
        // The first lane that counts and the last are at opposite corners, where the x of the rolled camera
        // is extreme.
        const int items = 50, first = v.width / 3;
        for (int item = 0; item < items; ++item) {
          const int row = static_cast<int>(random.uniform(0, film.height - 0.01));
          const double upwards = 1 - 2 * ((row + 0.5) / film.height + film.principal_y);
          const double diagonal = (1 - upwards * film.height / film.width) / 2 - film.principal_x;
          const int column =
              rolled ? std::clamp(static_cast<int>(diagonal * film.width) + item % 9 - 4, 0, film.width - 1)
                     : static_cast<int>(random.uniform(0, film.width - 0.01));
          const auto low = static_cast<float>(-random.uniform(0, 0.5)), high = 1.0f - low;
          for (int lane = 0; lane < v.width; ++lane) {
            pixel.push_back(row * film.width + column);
            us.push_back(lane < first ? -9.0f : lane == first ? low : lane == v.width - 1 ? high : 0.7f);
            vs.push_back(lane == first ? high : lane == v.width - 1 ? low : 0.4f);
            counts.push_back(lane >= first);
          }
        }
        std::vector<Bounds> bounds(pixel.size());
        std::vector<Float3> direction(pixel.size());
        program.run("bound_pixels", pixel.size(), pixel, us, vs, counts, out(bounds), out(direction));
        for (std::size_t i = 0; i < pixel.size(); ++i) {
          if (counts[i] == 0) continue;
          CAPTURE(i, pixel[i], us[i], vs[i]);
          const Bounds& b = bounds[i];
          const dvec3 across = to_double(b.across), down = to_double(b.down), ray = to_double(direction[i]);
          const dvec3 unscaled = ray / glm::dot(ray, camera.forward);
          const dvec3 difference = unscaled - to_double(b.direction);
          const double rounding = 2e-6 * (1 + camera.tan_half_fov_x) * glm::length(unscaled);
          REQUIRE(glm::length(to_double(b.origin) - origin) < 1e-6);
          REQUIRE(std::abs(glm::dot(difference, camera.left)) <= glm::length(across) + rounding);
          REQUIRE(std::abs(glm::dot(difference, camera.up)) <= glm::length(down) + rounding);
          const double across_film = static_cast<double>(us[i / v.width * v.width + v.width - 1]) -
                                     us[i / v.width * v.width + first];
          if (v.width > 1)
            REQUIRE(glm::length(across) ==
                    Approx(2 * camera.tan_half_fov_x * across_film / (2 * film.width)).epsilon(1e-4));
          if (b.same_signs == 0) continue;
          for (int axis = 0; axis < 3; ++axis) {
            const double size = std::abs(unscaled[axis]);
            REQUIRE(size * (1 - 1e-6) <= 1 / std::abs(to_double(b.fast_inverse)[axis]));
            REQUIRE(size * (1 + 1e-6) >= 1 / std::abs(to_double(b.slow_inverse)[axis]));
          }
        }
      }
}

TEST_CASE("camera: what is beyond the film's borders, or behind, is not seen") {
  for (const Variant v : variants)
    for (const Film& film : films) {
      CAPTURE(v, film.width, film.height);
      const Scene scene = scene_of(film);
      const SceneProgram program = program_for(v, scene);
      // Half a pixel outside: truncation to integers would assign it to the first column or row.
      const double beyond_x = 0.5 / film.width, beyond_y = 0.5 / film.height;
      std::vector<dvec3> directions;
      for (const double along : {0.01, 0.3, 0.99}) {
        for (const double x : {-beyond_x, 1 + beyond_x})
          directions.push_back(through(scene.camera, x, along));
        for (const double y : {-beyond_y, 1 + beyond_y})
          directions.push_back(through(scene.camera, along, y));
        directions.push_back(
            -through(scene.camera, along, 0.4)); // whose projection onto the image plane is the same point
      }
      directions.push_back(-scene.camera.forward);
      const Seen s = see(program, directions);
      CHECK(s.seen == std::vector<int>(directions.size(), 0));
      for (const int pixel : s.pixel)
        CHECK((pixel >= 0 && pixel < film.width * film.height)); // an index that may be read
    }
}

TEST_CASE("camera: over all directions the density is 1, and as much for every pixel") {
  for (const Film& film : {films[1], films[2], films[3]}) {
    CAPTURE(film.width, film.height);
    const Scene scene = scene_of(film);
    const SceneProgram program = program_for(variants[3], scene);
    // Midpoints of the cells of a lattice in the image plane, wider than the film, with known solid angles.
    const int columns = 12 * film.width, rows = 12 * film.height;
    std::vector<dvec3> directions;
    std::vector<double> solid_angles;
    const double step_x = 1.5 / columns, step_y = 1.5 / rows;
    for (int i = 0; i < columns * rows; ++i) {
      const double x = -0.25 + (i % columns + 0.5) * step_x, y = -0.25 + (i / columns + 0.5) * step_y;
      directions.push_back(through(scene.camera, x, y));
      const double cosine = glm::dot(directions.back(), scene.camera.forward);
      solid_angles.push_back(film_area(scene.camera) * step_x * step_y * cosine * cosine * cosine);
    }
    const Seen s = see(program, directions);
    std::vector<double> of_pixel(static_cast<std::size_t>(film.width * film.height), 0.0);
    for (std::size_t i = 0; i < directions.size(); ++i)
      if (s.seen[i] != 0) of_pixel[static_cast<std::size_t>(s.pixel[i])] += s.density[i] * solid_angles[i];
    double total = 0;
    for (const double part : of_pixel) {
      total += part;
      REQUIRE(part * static_cast<double>(of_pixel.size()) == Approx(1).epsilon(1e-4));
    }
    CHECK(total == Approx(1).epsilon(1e-4));
  }
}
