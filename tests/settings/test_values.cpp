#include "settings/values.h"

#include <limits>

#include <catch2/catch.hpp>

#include "errors.h"

using namespace phlux;

TEST_CASE("Texts become values") {
  CHECK(settings::whole_number("--seed", "18446744073709551615", 0,
                               std::numeric_limits<std::uint64_t>::max()) ==
        std::numeric_limits<std::uint64_t>::max());
  CHECK(settings::whole_number("--spp", "010", 1, 100) == 10);
  CHECK(settings::depth("--max-depth", "-1") == -1);
  CHECK(settings::number_within("--error", "1e-2", 0, 1) == 0.01);
  CHECK(settings::size("--size", "640x480") == std::array{640, 480});
  CHECK(settings::definition("-D", "a=b=c") == std::pair<std::string, std::string>{"a", "b=c"});
  CHECK(settings::definition("-D", "a=").second.empty());
  CHECK(settings::choice("--connect", "mis", {"none", "light", "mis"}) == 2);
}

TEST_CASE("An invalid value is a UsageError") {
  CHECK_THROWS_AS(settings::whole_number("--seed", "0x10", 0, 100), UsageError);
  CHECK_THROWS_AS(settings::whole_number("--seed", "", 0, 100), UsageError);
  CHECK_THROWS_AS(settings::whole_number("--seed", "18446744073709551616", 0, 100), UsageError);
  CHECK_THROWS_AS(settings::number_within("--time", "1s", 0, 1), UsageError);
  CHECK_THROWS_AS(settings::size("--size", "16384x16385"), UsageError);
  CHECK_THROWS_AS(settings::size("--size", "x"), UsageError);
  CHECK_THROWS_WITH(settings::size("--size", "268435456x1"),
                    Catch::Contains("at most 32768 pixels along each side"));
  CHECK_THROWS_AS(settings::window("--crop", "0,0,1,32769"), UsageError);
  CHECK(settings::size("--size", "32768x8192") == std::array{32768, 8192});
  CHECK_THROWS_AS(settings::definition("-D", "=b"), UsageError);
}

TEST_CASE("Only a similar name is suggested") {
  const std::vector<std::string> names = {"cosine", "mixture", "-n", "--spp"};
  CHECK(settings::nearest("cosin", names) == "cosine");
  CHECK(settings::nearest("mxitrue", names).empty()); // four edits
  CHECK(settings::nearest("-x", names) == "-n");
  CHECK(settings::nearest("x", names).empty());
}
