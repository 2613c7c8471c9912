#include "render/render.h"

namespace phlux::render {

const std::vector<std::string>& connect_names() {
  static const std::vector<std::string> names = {"none", "light", "mis"};
  return names;
}

const std::vector<std::string>& weights_names() {
  static const std::vector<std::string> names = {"balance", "power", "uniform"};
  return names;
}

const std::vector<std::string>& light_selection_names() {
  static const std::vector<std::string> names = {"power", "contribution"};
  return names;
}

const std::vector<std::string>& traversal_names() {
  static const std::vector<std::string> names = {"auto", "brute", "bvh"};
  return names;
}

} // namespace phlux::render
