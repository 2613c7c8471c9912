#include "random/scene_draft.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace phlux::test {

using scene::Vec3;

namespace {

// Random numbers of a scene; no two scenes share a stream.
std::uint64_t stream_of(const SceneNumber& number) {
  return 1'000'003 * (number.member + 1) + (number.family << 24);
}

} // namespace

SceneDraft::SceneDraft(const SceneNumber& number, const std::optional<Twin>& twin_of)
    : structure(number.family), values(stream_of(number)), further(~(number.family << 32)), twin(twin_of),
      text(structure.pick<std::string>({"0.5.0", "0.6.0", "2.0.0", "3.0.0"}), values) {
  if (twin && twin->places > 0)
    places_.emplace(stream_of(number) + (static_cast<std::uint64_t>(twin->places) << 48));
}

void SceneDraft::open_to_world() {
  text.open("transform", fmt::format("name=\"{}\"", text.spelling("to_world")));
}

void SceneDraft::close_to_world() {
  if (values.chance(0.2)) {
    text.line(fmt::format("<matrix value=\"{0} 0 0 {1}, 0 {0} 0 {2}, 0 0 {0} {3}, 0 0 0 1\"/>",
                          SceneText::number(scale), SceneText::number(offset.x), SceneText::number(offset.y),
                          SceneText::number(offset.z)));
  } else {
    text.line(fmt::format("<scale value=\"{}\"/>", SceneText::number(scale)));
    if (offset != Vec3(0.0)) text.triple("translate", offset);
  }
  text.close("transform");
}

std::string rgbe_file(int width, const std::vector<scene::Rgb>& pixels) {
  std::string bytes = fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n",
                                  static_cast<int>(pixels.size()) / width, width);
  for (const scene::Rgb& pixel : pixels) {
    int exponent = 0;
    const double largest = std::max({pixel.r, pixel.g, pixel.b});
    std::frexp(largest, &exponent);
    for (int c = 0; c < 3; ++c) bytes += static_cast<char>(std::ldexp(pixel[c], 8 - exponent));
    bytes += static_cast<char>(largest > 0 ? exponent + 128 : 0);
  }
  return bytes;
}

Vec3 triple(RandomNumbers& random, double from, double to) {
  return {random.uniform(from, to), random.uniform(from, to), random.uniform(from, to)};
}

Vec3 unit_vector(RandomNumbers& random) {
  while (true) {
    const Vec3 v = triple(random, -1, 1);
    const double square = glm::dot(v, v);
    if (square > 0.01 && square < 1) return v / std::sqrt(square);
  }
}

Vec3 above_floor(RandomNumbers& random, double nearest, double farthest) {
  Vec3 v = unit_vector(random);
  v.y = std::abs(v.y);
  v.z = std::abs(v.z) + 0.2;
  return random.uniform(nearest, farthest) * glm::normalize(v);
}

Vec3 up_for(const Vec3& axis) {
  return std::abs(axis.y) < 0.9 * glm::length(axis) ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
}

std::string attribute(const char* name, const Vec3& value) {
  return fmt::format("{}=\"{}\"", name, SceneText::numbers(value));
}

std::string look_at(const char* tag, const Vec3& origin, const Vec3& target, const Vec3& up) {
  return fmt::format("<{} {} {} {}/>", tag, attribute("origin", origin), attribute("target", target),
                     attribute("up", up));
}

} // namespace phlux::test
