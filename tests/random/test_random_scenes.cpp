// Random scenes, each rendered by several methods, which must agree: 18 in two test cases, and any number
// with `test_random_scenes "[.long]"`, see random/long_run.cpp.
#include <catch2/catch.hpp>
#include <spdlog/spdlog.h>

#include "random/agreement_of_methods.h"

using namespace phlux::test;

namespace {

constexpr int members = 3, methods = 4, samples_per_pixel = 64;

void check_families(std::uint64_t first, std::uint64_t end) {
  spdlog::set_level(spdlog::level::err);
  int scenes = 0, dark = 0, pairs = 0, excused = 0;
  for (std::uint64_t family = first; family < end; ++family)
    for (std::uint64_t member = 0; member < members; ++member) {
      const std::vector<SceneAgreement> all =
          agreement_with_twin({family, member}, methods, samples_per_pixel);
      for (const SceneAgreement& agreement : all) {
        INFO(agreement.message() << "written by PHLUX_RANDOM_SCENE=\"" << agreement.name
                                 << "\" test_random_scenes \"[write]\"");
        CHECK(agreement.holds());
      }
      ++scenes;
      dark += all.front().dark ? 1 : 0;
      pairs += static_cast<int>(all.front().pairs.size());
      excused += all.front().excused();
    }
  // Otherwise few pairs are compared.
  CAPTURE(scenes, dark, pairs, excused);
  CHECK(dark < scenes / 2);
  CHECK(excused < most_excused(end - first) * pairs);
}

} // namespace

TEST_CASE("random scenes: families 0 to 2 are the same by all of their methods", "[first]") {
  check_families(0, 3);
}

TEST_CASE("random scenes: families 3 to 5 are the same by all of their methods", "[second]") {
  check_families(3, 6);
}
