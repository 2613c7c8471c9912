#include "accel/tree.h"

#include <algorithm>
#include <atomic>
#include <type_traits>

#include "errors.h"

namespace phlux::accel {
namespace {

template<auto release>
struct Releaser {
  template<typename T>
  void operator()(T* handle) const {
    release(handle);
  }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Releaser<rtcReleaseDevice>>;
using EmbreeBvh = std::unique_ptr<std::remove_pointer_t<RTCBVH>, Releaser<rtcReleaseBVH>>;

using Node = Tree::Node;

template<typename T>
std::span<T> allocate(RTCThreadLocalAllocator allocator, std::size_t count) {
  T* first = static_cast<T*>(
      rtcThreadLocalAlloc(allocator, count * sizeof(T), std::max<std::size_t>(alignof(T), 16)));
  std::uninitialized_value_construct_n(first, count);
  return {first, count};
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned children, void*) {
  Node* node = allocate<Node>(allocator, 1).data();
  node->children = allocate<Node*>(allocator, children);
  node->boxes = allocate<RTCBounds>(allocator, children);
  return node;
}

void set_children(void* node, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i)
    static_cast<Node*>(node)->children[i] = static_cast<Node*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) static_cast<Node*>(node)->boxes[i] = *bounds[i];
}

} // namespace

// The state that Embree's callbacks share; owns the nodes.
struct Tree::Builder {
  EmbreeDevice device{rtcNewDevice(nullptr)};
  EmbreeBvh bvh;
  std::vector<RTCBuildPrimitive> leaf_primitives;
  std::atomic<std::size_t> used{0};

  static void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                           std::size_t count, void* user) {
    Builder& builder = *static_cast<Builder*>(user);
    const std::span leaf(builder.leaf_primitives.data() + builder.used.fetch_add(count), count);
    std::copy_n(primitives, count, leaf.begin());
    // The order within a leaf depends on the threads.
    std::sort(leaf.begin(), leaf.end(), [](const auto& a, const auto& b) {
      return a.geomID != b.geomID ? a.geomID < b.geomID : a.primID < b.primID;
    });
    Node* node = allocate<Node>(allocator, 1).data();
    node->primitives = leaf;
    return node;
  }
};

Tree::Tree(std::vector<RTCBuildPrimitive> primitives, const Shape& shape)
    : builder_(std::make_unique<Builder>()) {
  if (primitives.empty()) throw SceneError("a hierarchy needs at least one shape");
  if (!builder_->device) throw SceneError("Embree cannot start to build a hierarchy");
  builder_->bvh.reset(rtcNewBVH(builder_->device.get()));
  builder_->leaf_primitives.resize(primitives.size());
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = shape.branching;
  arguments.maxDepth = shape.max_depth;
  arguments.sahBlockSize = shape.block;
  arguments.minLeafSize = 1;
  arguments.maxLeafSize = shape.leaf_size;
  arguments.bvh = builder_->bvh.get();
  arguments.primitives = primitives.data();
  arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = Builder::create_leaf;
  arguments.userPtr = builder_.get();
  root_ = static_cast<const Node*>(rtcBuildBVH(&arguments));
  if (root_ == nullptr)
    throw SceneError("Embree could not build a hierarchy: too little memory, or too deep");
}

Tree::~Tree() = default;

} // namespace phlux::accel
