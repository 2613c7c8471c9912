// The image does not depend on WIDTH or on the traversal.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "images/evidence.h"
#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;
using render::Traversal;

namespace {

constexpr int side = 16;

render::Settings with(int lanes, Traversal traversal, std::uint64_t seed, int samples) {
  render::Settings result = settings_for(samples);
  result.lanes = lanes;
  result.traversal = traversal;
  result.seed = seed;
  return result;
}

bool close(const Channels& a, const Channels& b) {
  return std::ranges::equal(a, b,
                            [](double x, double y) { return std::abs(x - y) <= 1e-4 * std::max(x, y); });
}

// Share of the pixels that differ by more than rounding. One path in thousands differs because a ray passes
// an edge on the other side.
double differing_share(const film::Film& a, const film::Film& b) {
  int differing = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) differing += !close(a.mean(i), b.mean(i));
  return differing / static_cast<double>(a.pixels().size());
}

// Compares pixels with few samples for the same seed, and means for different seeds.
void check_same(const scene::Scene& scene, int lanes, Traversal traversal, const Render& reference,
                const Render& few) {
  CAPTURE(lanes, static_cast<int>(traversal));
  const Render same_seed = render_of(scene, with(lanes, traversal, 1, 8));
  CHECK(same_seed.statistics.lanes == lanes);
  CHECK(differing_share(same_seed.film, few.film) < 0.03);
  const Render other_seed = render_of(scene, with(lanes, traversal, 100 + static_cast<unsigned>(lanes), 256));
  check_agreement(tiles(estimate_of(other_seed.film), 4), tiles(estimate_of(reference.film), 4));
}

} // namespace

TEST_CASE("1, 4, 8 and 16 lanes render the same image, testing every shape in turn") {
  const scene::Scene scene = shipped("cornell-box", side, side);
  const Render reference = render_of(scene, with(16, Traversal::brute_force, 1, 512));
  const Render few = render_of(scene, with(16, Traversal::brute_force, 1, 8));
  CHECK(reference.statistics.traversal == "brute");
  for (const int lanes : {1, 4, 8}) check_same(scene, lanes, Traversal::brute_force, reference, few);
}

TEST_CASE("1, 4, 8 and 16 lanes render the same image of a mesh") {
  const scene::Scene scene = shipped("mesh", side, side);
  const Render reference = render_of(scene, with(16, Traversal::automatic, 1, 512));
  const Render few = render_of(scene, with(16, Traversal::automatic, 1, 8));
  CHECK(reference.statistics.traversal == "bvh");
  for (const int lanes : {1, 4, 8}) check_same(scene, lanes, Traversal::automatic, reference, few);
}

TEST_CASE("a hierarchy finds what testing every shape in turn finds") {
  const scene::Scene scene = shipped("caustic", side, side); // every kind of shape but triangles
  const Render reference = render_of(scene, with(16, Traversal::brute_force, 1, 512));
  const Render few = render_of(scene, with(16, Traversal::brute_force, 1, 8));
  for (const int lanes : {1, 16}) check_same(scene, lanes, Traversal::bvh, reference, few);
}
