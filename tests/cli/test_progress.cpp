#include "cli/progress.h"

#include <limits>

#include <catch2/catch.hpp>

using namespace phlux;

TEST_CASE("Progress is the largest of those of the limits") {
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
