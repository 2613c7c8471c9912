// Both traversals find the same hits, and rays that leave a surface do not hit it again.
#include <cmath>
#include <numbers>
#include <vector>

#include "directions.h"
#include "scene_test.h"

using namespace device_test;
using glm::dvec3;
using phlux::scene::Patch;
using phlux::scene::Scene;

namespace {

struct Ray {
  Float3 origin, direction;
};
struct Traced {
  float distance;
  int material, blocked;
};
struct Bounds {
  Float3 origin, centre, across, down;
};
struct Left {
  int material, front, next_material, outward;
  float distance, next_distance, error;
  Float3 position, normal;
};

// Adds shapes with distinct materials, by which the tests identify them.
class Shapes {
public:
  void triangle(const dvec3& a, const dvec3& b, const dvec3& c) {
    scene.meshes.push_back({{a, b, c}, {}, {{0, 1, 2}}, surface()});
  }
  void patch(Patch::Region region, const dvec3& origin, const dvec3& u, const dvec3& v) {
    scene.patches.push_back({region, origin, u, v, surface()});
  }
  void sphere(const dvec3& center, double radius, bool front_is_inside = false) {
    scene.spheres.push_back({center, radius, front_is_inside, surface()});
  }
  Scene scene;

private:
  phlux::scene::Surface surface() {
    scene.materials.push_back(phlux::lobes::diffuse(phlux::scene::Rgb(0.5)));
    return {static_cast<int>(scene.materials.size()) - 1, -1};
  }
};

Scene random_scene(unsigned kinds) {
  Random random(61 + kinds);
  Shapes shapes;
  for (int i = 0; i < 90; ++i) {
    const dvec3 at = 10.0 * random.point();
    const double size = std::exp2(random.uniform(-2, kinds == 15 ? 1.5 : 3));
    const dvec3 u = size * random.direction(), v = size * random.uniform(0.2, 1) * random.direction();
    if ((kinds & 1) != 0) shapes.triangle(at, at + u, at + v);
    if ((kinds & 2) != 0) shapes.patch(Patch::Region::parallelogram, 10.0 * random.point(), v, u);
    if ((kinds & 4) != 0) shapes.patch(Patch::Region::ellipse, 10.0 * random.point(), u, v);
    if ((kinds & 8) != 0) shapes.sphere(10.0 * random.point(), 0.5 * size);
  }
  return shapes.scene;
}

struct Rays {
  std::vector<Ray> rays;
  std::vector<float> limits;
  std::vector<int> asking;
};

// Rays between random points of the scene, some along the axes, with limits before and behind their hits.
Rays random_rays(std::size_t count) {
  Random random(62);
  Rays r;
  for (std::size_t i = 0; i < count; ++i) {
    dvec3 direction = random.direction();
    if (i % 16 == 0) {
      direction = dvec3(0);
      direction[static_cast<int>(i / 16 % 3)] = i % 32 == 0 ? 1 : -1;
    }
    r.rays.push_back({to_float(random.uniform(0, 15) * random.point()), to_float(direction)});
    r.limits.push_back(static_cast<float>(std::exp2(random.uniform(-2, 5))));
    r.asking.push_back(random.word() % 8 != 0);
  }
  return r;
}

std::vector<Traced> trace(Variant v, const Scene& scene, phlux::render::Traversal traversal, const Rays& r) {
  const SceneProgram program(v, "traverse.cl", scene, "exact", traversal);
  std::vector<Traced> traced(r.rays.size());
  program.run("trace", traced.size(), r.rays, r.limits, r.asking, out(traced));
  return traced;
}

void compare(Variant v, const Scene& scene) {
  const Rays r = random_rays(thinned(20000, 640));
  const auto brute = trace(v, scene, phlux::render::Traversal::brute_force, r);
  const auto hierarchy = trace(v, scene, phlux::render::Traversal::bvh, r);
  std::size_t hits = 0, blocked = 0, different = 0;
  for (std::size_t i = 0; i < r.rays.size(); ++i) {
    if (r.asking[i] == 0) {
      REQUIRE(brute[i].blocked == 0);
      REQUIRE(hierarchy[i].blocked == 0);
      continue;
    }
    const Traced &a = brute[i], &b = hierarchy[i];
    // Rounding may differ between the two programs, so a ray through an edge may miss it in one.
    const bool same = a.material == b.material &&
                      (a.material < 0 || std::abs(a.distance - b.distance) <= 1e-5f * a.distance);
    const bool tie =
        a.material >= 0 && b.material >= 0 && std::abs(a.distance - b.distance) <= 1e-6f * a.distance;
    if (!same && !tie) {
      ++different;
      continue;
    }
    hits += a.material >= 0;
    blocked += a.blocked != 0;
    const bool before = a.material >= 0 && a.distance < r.limits[i];
    const bool near_limit = a.material >= 0 && std::abs(a.distance - r.limits[i]) <= 1e-5f * a.distance;
    if (!near_limit) {
      REQUIRE((a.blocked != 0) == before);
      REQUIRE((b.blocked != 0) == before);
    }
  }
  CHECK(different <= r.rays.size() / 5000);
  CHECK(hits > r.rays.size() / 20);
  CHECK(blocked >= r.rays.size() / 60);
}

// Packets from random points, 2^-12 to 1 radian wide, some of them along an axis.
struct Packets {
  std::vector<Bounds> bounds; // one per lane
  std::vector<float> a, b;
  std::vector<int> asking;
};
Packets random_packets(std::size_t count, int width) {
  Random random(64);
  Packets p;
  for (std::size_t i = 0; i < count; ++i) {
    const dvec3 origin = random.uniform(0, 15) * random.point();
    const dvec3 centre =
        i % 8 == 0 ? dvec3(i % 16 == 0 ? 1 : -1, 0, 0) : glm::normalize(8.0 * random.point() - origin);
    const dvec3 across = glm::normalize(glm::cross(centre, random.direction()));
    const dvec3 down = glm::cross(centre, across);
    const double size = std::exp2(random.uniform(-13, -1)), shape = random.uniform(0.1, 1);
    const Bounds bounds = {to_float(origin), to_float(centre), to_float(size * across),
                           to_float(shape * size * down)};
    for (int lane = 0; lane < width; ++lane) {
      p.bounds.push_back(bounds);
      p.a.push_back(static_cast<float>(random.uniform(-1, 1)));
      p.b.push_back(static_cast<float>(random.uniform(-1, 1)));
      p.asking.push_back(random.word() % 8 != 0);
    }
  }
  return p;
}

void compare_packets(Variant v, const Scene& scene) {
  const SceneProgram program(v, "traverse.cl", scene, "exact", phlux::render::Traversal::bvh);
  const Packets p = random_packets(thinned(4000, 200), v.width);
  std::vector<float> packet_distance(p.a.size()), distance(p.a.size());
  std::vector<int> packet_material(p.a.size()), material(p.a.size()), together(p.a.size());
  program.run("trace_packets", p.a.size(), p.bounds, p.a, p.b, p.asking, out(packet_distance),
              out(packet_material), out(distance), out(material), out(together));
  std::size_t packets = 0, hits = 0;
  for (std::size_t i = 0; i < p.a.size(); ++i) {
    if (p.asking[i] == 0) continue;
    packets += together[i] != 0;
    hits += together[i] != 0 && material[i] >= 0;
    CAPTURE(i, together[i], packet_distance[i], distance[i]);
    REQUIRE(packet_material[i] == material[i]);
    if (material[i] >= 0) REQUIRE(packet_distance[i] == distance[i]);
  }
  CHECK(packets > p.a.size() / 2);
  CHECK(hits > p.a.size() / 100);
}

// One shape under test and, to the side, small ones that move the centre of the scene away from it.
Scene alone(double size, int kind, double aside) {
  Shapes shapes;
  const dvec3 u(size, 0, 0), v(0.3 * size, 0.6 * size, 0.7 * size), there = aside * size * dvec3(1, 0.5, 0.3);
  if (kind == 0) shapes.triangle(-u, u, 2.0 * v);
  if (kind == 1) shapes.patch(Patch::Region::parallelogram, dvec3(0), u, v);
  if (kind == 2) shapes.patch(Patch::Region::ellipse, dvec3(0), u, v);
  if (kind >= 3) shapes.sphere(dvec3(0), size, kind == 4);
  shapes.triangle(there, there + 0.01 * u, there + 0.01 * v);
  shapes.patch(Patch::Region::parallelogram, there, 0.01 * u, 0.01 * v);
  shapes.patch(Patch::Region::ellipse, there, 0.01 * u, 0.01 * v);
  shapes.sphere(there, 0.01 * size);
  return shapes.scene;
}

void check_leaving(Variant v, double size, int kind, double aside) {
  CAPTURE(v, size, kind, aside);
  const SceneProgram program(v, "traverse.cl", alone(size, kind, aside));
  const dvec3 origin = program.host().geometry->origin;
  Random random(63);
  std::vector<Ray> rays;
  std::vector<Float3> given;
  for (std::size_t i = 0; i < thinned(4000); ++i) {
    const dvec3 target = size * random.uniform(0, 0.9) * random.direction();
    const dvec3 from = kind >= 3 && i % 2 == 0 ? size * random.uniform(0, 0.9) * random.direction()
                                               : size * random.uniform(1.5, 20) * random.direction();
    rays.push_back({to_float(from - origin), to_float(glm::normalize(target - from))});
    dvec3 direction = random.direction();
    if (i % 3 == 0) // grazing
      direction =
          glm::normalize(dvec3(direction.x, direction.y, direction.z * std::exp2(-random.uniform(0, 12))));
    given.push_back(to_float(direction));
  }
  std::vector<Left> left(rays.size());
  program.run("leave", left.size(), rays, given, out(left));
  std::size_t found = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const Left& l = left[i];
    if (l.material != 0) continue;
    ++found;
    CAPTURE(i, given[i].z, l.distance, l.next_distance, l.error);
    const bool round = kind >= 3;
    const dvec3 position = to_double(l.position) + origin, normal = to_double(l.normal);
    if (round) {
      // The distance of the position from the sphere is a fraction of the offset, and the normal is that of
      // the sphere.
      REQUIRE(std::abs(glm::length(position) - size) <= 0.5 * l.error);
      const double side = glm::dot(normal, position) / size; // 1: arrived from outside
      REQUIRE(std::abs(std::abs(side) - 1) <= 1e-3);
      REQUIRE((l.front != 0) == ((side > 0) == (kind == 3)));
      const bool outside = (side > 0) == (l.outward != 0);
      if (outside) {
        REQUIRE(l.next_material != 0);
      } else if (l.next_material <= 0) { // the small shapes may be in between
        const double chord = 2 * size * std::abs(given[i].z);
        REQUIRE(l.next_material == 0);
        // The effect of the offset and of the error of the position on a chord grows as the chord gets
        // shorter.
        REQUIRE(std::abs(l.next_distance - chord) <= 4 * l.error / std::abs(given[i].z));
      }
    } else {
      REQUIRE(l.next_material != 0);
    }
  }
  CHECK(found > left.size() / 10);
}

} // namespace

TEST_CASE("traverse: brute force and hierarchy find the same primitives at the same distances") {
  for (const Variant v : variants)
    for (const unsigned kinds : {15u, v.width == 1 ? 1u : v.width == 4 ? 8u : v.width == 8 ? 7u : 12u}) {
      CAPTURE(v, kinds);
      compare(v, random_scene(kinds));
    }
}

TEST_CASE("traverse: rays of a packet have the hits that they have one by one") {
  for (const Variant v : variants)
    for (const unsigned kinds : {15u, 1u, 2u, 4u, 8u}) {
      CAPTURE(v, kinds);
      compare_packets(v, random_scene(kinds));
    }
}

TEST_CASE("surface: a ray that leaves a surface does not hit it again, and crosses a sphere from inside") {
  for (const Variant v : variants)
    for (int kind = 0; kind < 5; ++kind)
      for (const double size : {1.0, 1e4, 1e-4})
        for (const double aside : {3.0, 30.0}) check_leaving(v, size, kind, aside);
}
