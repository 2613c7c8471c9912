#include <limits>

#include <catch2/catch.hpp>

#include "measure/statistics.h"

using namespace phlux::measure;

TEST_CASE("Student's t: tabulated quantiles, and the normal distribution for many degrees of freedom") {
  CHECK(student_p(2.228139, 10) == Approx(0.05).epsilon(1e-5));
  CHECK(student_p(-3.169273, 10) == Approx(0.01).epsilon(1e-5));
  CHECK(student_p(0, 5) == Approx(1));
  CHECK(student_p(4, 1e7) == Approx(normal_p(4)).epsilon(1e-4));
  CHECK(student_p(std::numeric_limits<double>::infinity(), 63) == 0);
}
