#include "cli/values.h"

#include <limits>

#include <catch2/catch.hpp>

#include "cli/progress.h"
#include "errors.h"

using namespace phlux;

TEST_CASE("Texts become values") {
  CHECK(cli::whole_number("--seed", "18446744073709551615", 0, std::numeric_limits<std::uint64_t>::max()) ==
        std::numeric_limits<std::uint64_t>::max());
  CHECK(cli::whole_number("--spp", "010", 1, 100) == 10);
  CHECK(cli::depth("--max-depth", "-1") == -1);
  CHECK(cli::positive_number("--error", "1e-2") == 0.01);
  CHECK(cli::size("--size", "640x480") == std::array{640, 480});
  CHECK(cli::definition("-D", "a=b=c") == std::pair<std::string, std::string>{"a", "b=c"});
  CHECK(cli::definition("-D", "a=").second.empty());
  CHECK(cli::choice("--connect", "mis", {"none", "light", "mis"}) == 2);
}

TEST_CASE("What is no value is a UsageError") {
  CHECK_THROWS_AS(cli::whole_number("--seed", "0x10", 0, 100), UsageError);
  CHECK_THROWS_AS(cli::whole_number("--seed", "", 0, 100), UsageError);
  CHECK_THROWS_AS(cli::whole_number("--seed", "18446744073709551616", 0, 100), UsageError);
  CHECK_THROWS_AS(cli::positive_number("--time", "1s"), UsageError);
  CHECK_THROWS_AS(cli::size("--size", "16384x16385"), UsageError);
  CHECK_THROWS_AS(cli::size("--size", "x"), UsageError);
  CHECK_THROWS_AS(cli::definition("-D", "=b"), UsageError);
}

TEST_CASE("Only a near name is offered") {
  const std::vector<std::string> names = {"cosine", "mixture", "-n", "--spp"};
  CHECK(cli::nearest("cosin", names) == "cosine");
  CHECK(cli::nearest("mxitrue", names).empty()); // four edits
  CHECK(cli::nearest("-x", names) == "-n");
  CHECK(cli::nearest("x", names).empty());
}

TEST_CASE("Progress is the furthest of what may end the render") {
  const double unknown = std::numeric_limits<double>::infinity();
  CHECK(cli::fraction_done({25.0, 100.0, 1.0, 0}, {}, {}, unknown) == 0.25);
  CHECK(cli::fraction_done({25.0, {}, 3.0, 0}, 4.0, {}, unknown) == 0.75);
  CHECK(cli::fraction_done({25.0, {}, 3.0, 0}, {}, 0.01, unknown) == 0.0);
  CHECK(cli::fraction_done({25.0, {}, 3.0, 0}, {}, 0.01, 0.02) ==
        0.25); // four times the samples halve the error
  CHECK(cli::fraction_done({25.0, {}, 3.0, 0}, 4.0, 0.01, 0.02) == 0.75);
  CHECK(cli::fraction_done({25.0, {}, 9.0, 0}, 4.0, {}, 0.02) == 1.0);
  CHECK(cli::progress_text({25.0, 100.0, 2.0, 4'000'000}, 0.25, 0.02) ==
        " 25%  25/100 samples  2 M paths/s  error 2%  0:06 left");
  CHECK(cli::progress_text({25.0, {}, 0.0, 0}, 0.0, unknown) == "  0%  25 samples");
}
