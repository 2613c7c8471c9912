// A bounding volume hierarchy, built by Embree.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "accel/embree.h"

namespace phlux::accel {

class Tree {
public:
  struct Node {
    std::span<Node*> children;                     ///< empty: a leaf
    std::span<RTCBounds> boxes;                    ///< of the children
    std::span<const RTCBuildPrimitive> primitives; ///< of a leaf, ordered by geomID and primID
  };

  struct Shape {
    unsigned branching; ///< largest number of children of a node
    unsigned leaf_size; ///< largest number of primitives of a leaf
    unsigned block;     ///< primitives that are tested together
    unsigned max_depth;
  };

  /// @throws SceneError for too little memory, or no primitive
  Tree(std::vector<RTCBuildPrimitive> primitives, const Shape& shape);
  ~Tree();
  Tree(Tree&&) = delete;

  [[nodiscard]] const Node& root() const { return *root_; }

private:
  struct Builder;
  std::unique_ptr<Builder> builder_;
  const Node* root_ = nullptr;
};

} // namespace phlux::accel
