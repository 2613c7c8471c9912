// Random scenes, rendered by several methods each, which must agree: 30 of them in two test cases, and as
// many as one likes by `test_random_scenes "[.long]"`, see random/long_run.cpp.
#include <catch2/catch.hpp>

#include "random/agreement_of_methods.h"
#include "random/random_scene.h"

using namespace phlux::test;

namespace {

constexpr int members = 3, methods = 4, samples_per_pixel = 64;

void check_families(std::uint64_t first, std::uint64_t end) {
  int scenes = 0, dark = 0, pairs = 0, not_comparable = 0;
  for (std::uint64_t family = first; family < end; ++family)
    for (std::uint64_t member = 0; member < members; ++member) {
      const SceneNumber number{family, member};
      const SceneAgreement agreement =
          agreement_of_methods(load_random_scene(number), methods_of_family(family, methods),
                               1000 * family + member, samples_per_pixel);
      INFO("scene " << name_of(number) << ", written by PHLUX_RANDOM_SCENE=" << name_of(number)
                    << " test_random_scenes \"[write]\"\n"
                    << agreement.message());
      CHECK(agreement.holds());
      ++scenes;
      if (agreement.dark) ++dark;
      for (const PairOfMethods& pair : agreement.pairs) {
        ++pairs;
        if (pair.outcome == Outcome::not_comparable) ++not_comparable;
      }
    }
  // Else little is compared.
  CAPTURE(scenes, dark, pairs, not_comparable);
  CHECK(dark < scenes / 2);
  CHECK(not_comparable < pairs / 8);
}

} // namespace

TEST_CASE("random scenes: families 0 to 4 are the same by all of their methods", "[first]") {
  check_families(0, 5);
}

TEST_CASE("random scenes: families 5 to 9 are the same by all of their methods", "[second]") {
  check_families(5, 10);
}
