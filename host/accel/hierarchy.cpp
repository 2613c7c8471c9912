// The hierarchy is built by Embree's builder, as a tree of pointers, and then laid out depth first so that
// the tables do not depend on the order in which threads made its nodes.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <span>

#include "accel/embree.h"
#include "accel/geometry.h"
#include "accel/primitive.h"
#include "errors.h"

namespace phlux::accel {
namespace {

constexpr std::size_t max_children = 16;
constexpr unsigned patch_geometry = 0xFFFFFFFE, sphere_geometry = 0xFFFFFFFF; // geomIDs; below: a mesh

Reference reference_of(const RTCBuildPrimitive& p) {
  if (p.geomID == patch_geometry) return {Reference::Kind::patch, p.primID, 0};
  if (p.geomID == sphere_geometry) return {Reference::Kind::sphere, p.primID, 0};
  return {Reference::Kind::mesh, p.geomID, p.primID};
}

struct Node {
  unsigned children = 0;         // 0: a leaf
  unsigned first = 0, count = 0; // leaf: primitives in Builder::leaf_primitives
  Node* child[max_children] = {};
  RTCBounds box[max_children] = {};
};

// What Embree's callbacks share.
struct Builder {
  std::vector<RTCBuildPrimitive> leaf_primitives;
  std::atomic<unsigned> used{0};
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned children, void*) {
  Node* node = new (rtcThreadLocalAlloc(allocator, sizeof(Node), alignof(Node))) Node;
  node->children = children;
  return node;
}

void set_children(void* node, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) static_cast<Node*>(node)->child[i] = static_cast<Node*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) static_cast<Node*>(node)->box[i] = *bounds[i];
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                  void* user) {
  Builder& builder = *static_cast<Builder*>(user);
  Node* node = new (rtcThreadLocalAlloc(allocator, sizeof(Node), alignof(Node))) Node;
  node->count = static_cast<unsigned>(count);
  node->first = builder.used.fetch_add(node->count);
  const auto first = builder.leaf_primitives.begin() + node->first;
  std::copy_n(primitives, count, first);
  // Threads may hand the same leaf over in another order; flat primitives come before spheres.
  std::sort(first, first + static_cast<std::ptrdiff_t>(count), [](const auto& a, const auto& b) {
    return a.geomID != b.geomID ? a.geomID < b.geomID : a.primID < b.primID;
  });
  return node;
}

std::vector<RTCBuildPrimitive> build_primitives(const scene::Scene& scene, const scene::Vec3& origin) {
  std::vector<RTCBuildPrimitive> primitives;
  primitives.reserve(count_primitives(scene));
  const auto add = [&](unsigned geometry, std::uint32_t element) {
    RTCBuildPrimitive p{};
    p.geomID = geometry;
    p.primID = element;
    const Box box = bounds(scene, origin, reference_of(p));
    p.lower_x = box.low[0], p.lower_y = box.low[1], p.lower_z = box.low[2];
    p.upper_x = box.high[0], p.upper_y = box.high[1], p.upper_z = box.high[2];
    primitives.push_back(p);
  };
  for (unsigned mesh = 0; mesh < scene.meshes.size(); ++mesh)
    for (std::uint32_t i = 0; i < scene.meshes[mesh].triangles.size(); ++i) add(mesh, i);
  for (std::uint32_t i = 0; i < scene.patches.size(); ++i) add(patch_geometry, i);
  for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) add(sphere_geometry, i);
  return primitives;
}

// Depth-first layout of the tree in a geometry's tables.
class Layout {
public:
  Layout(const scene::Scene& scene, Geometry& geometry, int lanes, Builder& builder)
      : geometry_(geometry), writer_(scene, geometry), builder_(builder),
        children_(static_cast<std::size_t>(std::max(lanes, 2))) {}

  int write(const Node& node) { return node.children == 0 ? write_leaf(node) : write_inner(node); }
  void finish() { writer_.finish(); }

private:
  struct Child {
    int reference;
    RTCBounds box;
  };

  int write_inner(const Node& node) {
    const std::size_t index = reserve_node();
    std::vector<Child> written;
    for (unsigned i = 0; i < node.children; ++i) written.push_back({write(*node.child[i]), node.box[i]});
    fill_node(index, written);
    return static_cast<int>(index);
  }

  // A leaf holds either flat primitives or spheres; where Embree put both together, a node stands above two
  // leaves.
  int write_leaf(const Node& leaf) {
    const std::span all(builder_.leaf_primitives.data() + leaf.first, leaf.count);
    const auto first_sphere =
        std::find_if(all.begin(), all.end(), [](const auto& p) { return p.geomID == sphere_geometry; });
    const std::span flats(all.begin(), first_sphere), spheres(first_sphere, all.end());
    if (spheres.empty()) return write_blocks(flats, false);
    if (flats.empty()) return write_blocks(spheres, true);
    const std::size_t index = reserve_node();
    fill_node(index,
              {{write_blocks(flats, false), box_of(flats)}, {write_blocks(spheres, true), box_of(spheres)}});
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

  int write_blocks(std::span<const RTCBuildPrimitive> primitives, bool spheres) {
    const int block = geometry_.block;
    const int first = (spheres ? writer_.finish_sphere_block() : writer_.finish_planar_block()) / block;
    for (const RTCBuildPrimitive& p : primitives) {
      if (spheres)
        writer_.add_sphere(reference_of(p));
      else
        writer_.add_planar(reference_of(p));
    }
    const int end = (spheres ? writer_.finish_sphere_block() : writer_.finish_planar_block()) / block;
    const int blocks =
        std::max(end - first, 1); // primitives without area leave an empty leaf: any block will do
    if (blocks > 16 || first >= 1 << 26)
      throw SceneError("the scene has more primitives than a hierarchy can index");
    return ~(first << 5 | (blocks - 1) << 1 | (spheres ? 1 : 0));
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
  Builder& builder_;
  std::size_t children_;
};

template<auto release>
struct Releaser {
  template<typename T>
  void operator()(T* handle) const {
    release(handle);
  }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Releaser<rtcReleaseDevice>>;
using EmbreeBvh = std::unique_ptr<std::remove_pointer_t<RTCBVH>, Releaser<rtcReleaseBVH>>;

RTCBuildArguments build_arguments(RTCBVH bvh, std::vector<RTCBuildPrimitive>& primitives, Builder& builder,
                                  int lanes) {
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = static_cast<unsigned>(std::max(lanes, 2));
  // One level is left for a node above a leaf of both kinds.
  arguments.maxDepth = static_cast<unsigned>(lanes == 1 ? max_depth_binary : max_depth_wide) - 1;
  arguments.sahBlockSize = static_cast<unsigned>(lanes);
  arguments.minLeafSize = 1;
  arguments.maxLeafSize = static_cast<unsigned>(std::max(lanes, 4));
  arguments.bvh = bvh;
  arguments.primitives = primitives.data();
  arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  arguments.userPtr = &builder;
  return arguments;
}

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
  std::vector<RTCBuildPrimitive> primitives = build_primitives(scene, geometry.origin);
  if (primitives.empty()) throw SceneError("a hierarchy needs at least one shape");
  geometry.radius = radius_of(primitives);

  const EmbreeDevice device(rtcNewDevice(nullptr));
  if (!device) throw SceneError("Embree cannot start to build the hierarchy");
  const EmbreeBvh bvh(rtcNewBVH(device.get()));
  Builder builder;
  builder.leaf_primitives.resize(primitives.size());
  const RTCBuildArguments arguments = build_arguments(bvh.get(), primitives, builder, lanes);
  const auto* root = static_cast<const Node*>(rtcBuildBVH(&arguments));
  if (root == nullptr) throw SceneError("Embree could not build the hierarchy: too little memory");
  primitives = {};

  Layout layout(scene, geometry, lanes, builder);
  geometry.root = layout.write(*root);
  layout.finish();
  return geometry;
}

} // namespace phlux::accel
