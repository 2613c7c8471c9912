#include "cli/spelling.h"

#include <catch2/catch.hpp>

using phlux::cli::with_options;

TEST_CASE("Settings that a message names become options, and nothing else does") {
  CHECK(with_options("`connect` none: use `connect` light, or leave out `rr-depth`") ==
        "--connect none: use --connect light, or leave out --rr-depth");
  CHECK(with_options("`phlux devices` lists them; `elephant`; seed; ``seed`") ==
        "`phlux devices` lists them; `elephant`; seed; `--seed");
  CHECK(with_options("`size` 3x2") == "--size 3x2");
  CHECK(with_options("`D` a=b") == "-D a=b");
  CHECK(with_options("") == "");
}
