// A bounding volume hierarchy, laid out depth first, so that the tables do not depend on the order in which
// threads create nodes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "accel/geometry.h"
#include "accel/primitive.h"
#include "accel/tree.h"
#include "errors.h"

namespace phlux::accel {
namespace {

// geomIDs, by which the primitives of a leaf are ordered; below: a mesh.
constexpr unsigned parallelogram_geometry = 0xFFFFFFFD, ellipse_geometry = 0xFFFFFFFE,
                   sphere_geometry = 0xFFFFFFFF;
constexpr int kinds_of_primitives = 4;

// As in the leaves of kernels/scene/scene_data.h.
int kind_of(const RTCBuildPrimitive& p) {
  if (p.geomID == sphere_geometry) return LEAF_SPHERES;
  if (p.geomID == ellipse_geometry) return REGION_ELLIPSE;
  if (p.geomID == parallelogram_geometry) return REGION_PARALLELOGRAM;
  return REGION_TRIANGLE;
}

Reference reference_of(const RTCBuildPrimitive& p) {
  if (p.geomID < parallelogram_geometry) return {Reference::Kind::mesh, p.geomID, p.primID};
  return {p.geomID == sphere_geometry ? Reference::Kind::sphere : Reference::Kind::patch, p.primID, 0};
}

std::vector<RTCBuildPrimitive> build_primitives(const scene::Scene& scene, const scene::Vec3& origin,
                                                bool in_double) {
  std::vector<RTCBuildPrimitive> primitives;
  primitives.reserve(count_primitives(scene));
  const auto add = [&](unsigned geometry, std::uint32_t element) {
    RTCBuildPrimitive p{};
    p.geomID = geometry;
    p.primID = element;
    const Reference reference = reference_of(p);
    if (!has_area(scene, origin, reference, in_double)) return;
    const Box box = bounds(scene, origin, reference);
    p.lower_x = box.low[0], p.lower_y = box.low[1], p.lower_z = box.low[2];
    p.upper_x = box.high[0], p.upper_y = box.high[1], p.upper_z = box.high[2];
    primitives.push_back(p);
  };
  for (unsigned mesh = 0; mesh < scene.meshes.size(); ++mesh)
    for (std::uint32_t i = 0; i < scene.meshes[mesh].triangles.size(); ++i) add(mesh, i);
  for (std::uint32_t i = 0; i < scene.patches.size(); ++i)
    add(scene.patches[i].region == scene::Patch::Region::ellipse ? ellipse_geometry : parallelogram_geometry,
        i);
  for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) add(sphere_geometry, i);
  return primitives;
}

// Depth-first layout of the tree in a geometry's tables.
class Layout {
public:
  Layout(const scene::Scene& scene, Geometry& geometry, int lanes)
      : geometry_(geometry), writer_(scene, geometry),
        children_(static_cast<std::size_t>(std::max(lanes, 2))) {}

  int write(const Tree::Node& node) {
    return node.children.empty() ? write_leaf(node.primitives) : write_inner(node);
  }
  void finish() { writer_.finish(); }

private:
  struct Child {
    int reference;
    RTCBounds box;
  };

  int write_inner(const Tree::Node& node) {
    const std::size_t index = reserve_node();
    std::vector<Child> written;
    for (std::size_t i = 0; i < node.children.size(); ++i)
      written.push_back({write(*node.children[i]), node.boxes[i]});
    fill_node(index, written);
    return static_cast<int>(index);
  }

  // The primitives of a leaf are of one kind; a mixed leaf of Embree's becomes a node with a leaf of the
  // first kind and, as another child, the others.
  int write_leaf(std::span<const RTCBuildPrimitive> all) {
    const int kind = kind_of(all.front());
    const auto other = std::ranges::find_if(all, [&](const auto& p) { return kind_of(p) != kind; });
    const std::span first(all.begin(), other), others(other, all.end());
    if (others.empty()) return write_blocks(all, kind);
    const std::size_t index = reserve_node();
    const Child one{write_blocks(first, kind), box_of(first)}, rest{write_leaf(others), box_of(others)};
    fill_node(index, {one, rest});
    return static_cast<int>(index);
  }

  static RTCBounds box_of(std::span<const RTCBuildPrimitive> primitives) {
    RTCBounds b{};
    b.lower_x = b.lower_y = b.lower_z = std::numeric_limits<float>::infinity();
    b.upper_x = b.upper_y = b.upper_z = -std::numeric_limits<float>::infinity();
    for (const RTCBuildPrimitive& p : primitives) {
      b.lower_x = std::min(b.lower_x, p.lower_x), b.upper_x = std::max(b.upper_x, p.upper_x);
      b.lower_y = std::min(b.lower_y, p.lower_y), b.upper_y = std::max(b.upper_y, p.upper_y);
      b.lower_z = std::min(b.lower_z, p.lower_z), b.upper_z = std::max(b.upper_z, p.upper_z);
    }
    return b;
  }

  int write_blocks(std::span<const RTCBuildPrimitive> primitives, int kind) {
    const bool spheres = kind == LEAF_SPHERES;
    const int block = geometry_.block;
    const int first = (spheres ? writer_.finish_sphere_block() : writer_.finish_planar_block()) / block;
    for (const RTCBuildPrimitive& p : primitives) {
      if (spheres)
        writer_.add_sphere(reference_of(p));
      else
        writer_.add_planar(reference_of(p));
    }
    const int end = (spheres ? writer_.finish_sphere_block() : writer_.finish_planar_block()) / block;
    const int blocks = end - first;
    if (blocks > 8 || first >= 1 << 26)
      throw SceneError("the scene has more primitives than a hierarchy can index");
    return ~(first << 5 | (blocks - 1) << 2 | kind);
  }

  std::size_t reserve_node() {
    const std::size_t words = NODE_WORDS * children_;
    geometry_.nodes.resize(geometry_.nodes.size() + words, 0.0f);
    return geometry_.nodes.size() / words - 1;
  }

  void fill_node(std::size_t index, const std::vector<Child>& written) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    float* words = geometry_.nodes.data() + index * NODE_WORDS * children_;
    for (std::size_t i = 0; i < children_; ++i) {
      const bool used = i < written.size();
      const RTCBounds box = used ? written[i].box : RTCBounds{infinity,  infinity,  infinity,  0,
                                                              -infinity, -infinity, -infinity, 0};
      const float planes[6] = {box.lower_x, box.lower_y, box.lower_z, box.upper_x, box.upper_y, box.upper_z};
      for (std::size_t k = 0; k < 6; ++k) words[k * children_ + i] = planes[k];
      const int child = used ? written[i].reference : 0;
      std::copy_n(reinterpret_cast<const char*>(&child), sizeof(child),
                  reinterpret_cast<char*>(&words[NODE_CHILD * children_ + i]));
    }
  }

  Geometry& geometry_;
  TableWriter writer_;
  std::size_t children_;
};

double radius_of(const std::vector<RTCBuildPrimitive>& primitives) {
  double x = 0, y = 0, z = 0;
  for (const RTCBuildPrimitive& p : primitives) {
    x = std::max<double>({x, std::abs(p.lower_x), std::abs(p.upper_x)});
    y = std::max<double>({y, std::abs(p.lower_y), std::abs(p.upper_y)});
    z = std::max<double>({z, std::abs(p.lower_z), std::abs(p.upper_z)});
  }
  return std::hypot(x, y, z);
}

} // namespace

Geometry hierarchy(const scene::Scene& scene, int lanes, bool in_double) {
  Geometry geometry;
  geometry.in_double = in_double;
  geometry.block = lanes;
  geometry.origin = middle(scene);
  std::vector<RTCBuildPrimitive> primitives = build_primitives(scene, geometry.origin, in_double);
  if (primitives.empty() && count_primitives(scene) > 0) return geometry; // none has an area
  geometry.radius = radius_of(primitives);

  // Levels are reserved for the nodes that split a mixed leaf.
  const int most_levels = (lanes == 1 ? max_depth_binary : max_depth_wide) - (kinds_of_primitives - 1);
  const auto width = static_cast<unsigned>(lanes);
  const Tree tree(std::move(primitives), {.branching = std::max(width, 2u),
                                          .leaf_size = std::max(width, 4u),
                                          .block = width,
                                          .max_depth = static_cast<unsigned>(most_levels)});
  Layout layout(scene, geometry, lanes);
  geometry.root = layout.write(tree.root());
  layout.finish();
  return geometry;
}

} // namespace phlux::accel
