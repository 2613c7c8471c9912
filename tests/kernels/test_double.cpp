// lanes.h with PHLUX_DOUBLE: its own functions are accurate to double precision.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "kernels/device_test.h"

using namespace device_test;

namespace {

const Program* program_in_double(const std::string& file = "double.cl") {
  if (test_device().info.doubles) return &program_of(file, {1}, {{"PHLUX_DOUBLE", "1"}});
  WARN("the device has no doubles");
  return nullptr;
}

struct Vec3 {
  double x, y, z;
};

} // namespace

TEST_CASE("doubles: cosine and sine of turns to 1e-15, over the whole circle") {
  const Program* program = program_in_double("turns.cl");
  if (!program) return;
  std::vector<double> turns;
  for (int i = 0; i < 1000; ++i) turns.push_back((i + 1.0 / 3) / 1000);
  std::vector<double> cosine(turns.size()), sine(turns.size());
  program->run("turns", turns.size(), turns, out(cosine), out(sine));
  for (std::size_t i = 0; i < turns.size(); ++i) {
    CAPTURE(turns[i]);
    CHECK(std::abs(cosine[i] - std::cos(2 * std::numbers::pi * turns[i])) < 1e-15);
    CHECK(std::abs(sine[i] - std::sin(2 * std::numbers::pi * turns[i])) < 1e-15);
  }
}

TEST_CASE("doubles: signs of either zero, and ints that travel as Reals") {
  const Program* program = program_in_double();
  if (!program) return;
  const std::vector<double> x = {1.0 / 3, 1.0 / 3, -1.0 / 3, -1.0 / 3}, sign = {0.0, -0.0, 2.0, -1e-300};
  const std::vector<int> whole = {0, -1, 2147483647, -2147483647 - 1};
  std::vector<double> product(4);
  std::vector<int> carried(4);
  program->run("signs_and_ints", 4, x, sign, whole, out(product), out(carried));
  CHECK(product == std::vector{1.0 / 3, -1.0 / 3, -1.0 / 3, 1.0 / 3});
  CHECK(carried == whole);
}

TEST_CASE("doubles: vectors come back from a frame to 1e-15") {
  const Program* program = program_in_double();
  if (!program) return;
  const std::vector<Vec3> directions = {{1, 2, 3}, {-3, 1, -2}, {1e-9, 0, -1}, {0, 0, 1}, {1, 1e-7, 0}},
                          vectors(directions.size(), {0.1, 0.2, 0.3});
  std::vector<double> error(directions.size());
  program->run("there_and_back", directions.size(), directions, vectors, out(error));
  for (std::size_t i = 0; i < error.size(); ++i) {
    CAPTURE(i);
    CHECK(error[i] < 1e-15);
  }
}
