#include "tables/light_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "accel/tree.h"

namespace phlux::tables {
namespace {

using scene::Vec3;
constexpr double pi = std::numbers::pi;

// Embree's builder halves from 8 levels above it on, where 2^8 lights fit: more than a scene has left there.
constexpr unsigned max_depth = 64;

// Slightly larger than the lights' boxes: the builder splits by surface area, which is 0 for point lights on
// a line, so that it would split off one light at a time.
std::vector<RTCBuildPrimitive> boxes_of(std::span<const LightBounds> lights, const LightBounds& all) {
  const Vec3 extent = all.high - all.low;
  const double padding = 1e-3 * std::max({extent.x, extent.y, extent.z});
  std::vector<RTCBuildPrimitive> boxes(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const glm::vec3 from(lights[i].low - padding), to(lights[i].high + padding);
    boxes[i] = {from.x, from.y, from.z, 0, to.x, to.y, to.z, static_cast<unsigned>(i)};
  }
  return boxes;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

// A bounding box and bounding cone of all lights, and the sum of their intensities.
LightBounds bounds_of(std::span<const LightBounds> lights) {
  LightBounds all = lights.front();
  Vec3 axis(0.0);
  all.intensity = 0;
  for (const LightBounds& light : lights) {
    all.low = glm::min(all.low, light.low);
    all.high = glm::max(all.high, light.high);
    axis += light.intensity * light.axis;
    all.intensity += light.intensity;
  }
  const double length = glm::length(axis);
  const bool has_axis = length > 1e-6 * all.intensity;
  if (has_axis) all.axis = axis / length;
  all.spread = has_axis ? 0 : pi;
  for (const LightBounds& light : lights)
    all.spread = std::max(all.spread, angle_between(all.axis, light.axis) + light.spread);
  all.spread = std::min(all.spread, pi);
  return all;
}

// Depth first, so that the records do not depend on the order in which threads create nodes.
class Layout {
public:
  Layout(std::span<const LightBounds> lights, double intensity, std::vector<LightRecord>& records)
      : lights_(lights), records_(records), total_(intensity) {
    in_order_.reserve(lights.size());
    nodes_.reserve(2 * lights.size());
    nodes_.resize(2);
  }

  void write(const accel::Tree::Node& node, std::size_t index) {
    const std::size_t first_light = in_order_.size();
    if (node.children.empty()) {
      const LightBounds& light = lights_[node.primitives.front().primID];
      in_order_.push_back(light);
      nodes_[index].child = ~light.light;
      records_[static_cast<std::size_t>(light.light)].node = static_cast<int>(index);
    } else {
      const std::size_t first = nodes_.size();
      nodes_[index].child = static_cast<int>(first);
      nodes_.resize(first + 2);
      for (std::size_t i = 0; i < 2; ++i) {
        nodes_[first + i].parent = static_cast<int>(index);
        write(*node.children[i], first + i);
      }
    }
    fill(nodes_[index], bounds_of(std::span(in_order_).subspan(first_light)));
  }

  std::vector<LightNodeRecord> take() { return std::move(nodes_); }

private:
  void fill(LightNodeRecord& node, const LightBounds& bounds) const {
    for (int i = 0; i < 3; ++i) {
      node.center[i] = static_cast<float>((bounds.low[i] + bounds.high[i]) / 2);
      node.half_size[i] = static_cast<float>((bounds.high[i] - bounds.low[i]) / 2);
      node.axis[i] = static_cast<float>(bounds.axis[i]);
    }
    node.cos_spread = static_cast<float>(std::cos(bounds.spread));
    node.intensity = static_cast<float>(bounds.intensity / total_);
  }

  std::span<const LightBounds> lights_;
  std::vector<LightRecord>& records_;
  std::vector<LightBounds> in_order_;
  std::vector<LightNodeRecord> nodes_;
  double total_; // intensity
};

} // namespace

std::vector<LightNodeRecord> light_tree(std::span<const LightBounds> lights,
                                        std::vector<LightRecord>& records) {
  if (lights.size() < 2) return {};
  const LightBounds all = bounds_of(lights);
  const accel::Tree tree(boxes_of(lights, all),
                         {.branching = 2, .leaf_size = 1, .block = 1, .max_depth = max_depth});
  Layout layout(lights, all.intensity, records);
  layout.write(tree.root(), 0);
  return layout.take();
}

} // namespace phlux::tables
