// Verification passes on the device under test, and a wrong kernel fails the check for it.
#include <algorithm>
#include <string>

#include <catch2/catch.hpp>

#include "kernel_copy.h"
#include "verify/verify.h"

using namespace phlux;

namespace {

const device::Device& test_device() {
  static const device::Device device = device::open_devices({}).front();
  return device;
}

verify::Report run_quick(int lanes, std::vector<std::string> strategies = {},
                         sources::KernelFiles kernels = {}) {
  verify::Settings settings;
  settings.lanes = lanes;
  settings.quick = true;
  settings.strategies = std::move(strategies);
  settings.kernels = std::move(kernels);
  return verify::run(test_device(), settings);
}

std::string failures(const verify::Report& report) {
  std::string text;
  for (const verify::Result& result : report.results())
    if (!result.passed)
      text += result.strategy + " " + result.check + " " + std::to_string(result.worst) + " (" +
              result.where + ")\n";
  return text;
}

bool fails(const verify::Report& report, const std::string& check) {
  return std::ranges::any_of(report.results(),
                             [&](const verify::Result& r) { return !r.passed && r.check == check; });
}

} // namespace

TEST_CASE("verify: every strategy passes at every width", "[slow]") {
  for (const int lanes : {1, 4, 8, 16}) {
    CAPTURE(lanes);
    const verify::Report report = run_quick(lanes);
    CHECK(failures(report) == "");
    CHECK(report.passed());
    CHECK(report.results().size() > 150);
  }
}

TEST_CASE("verify: the default strategy passes") { // on interpreters too
  const verify::Report report = run_quick(4, {"exact"});
  CHECK(failures(report) == "");
}

TEST_CASE("verify: the printed estimate is named as biased", "[slow]") {
  const verify::Report report = run_quick(16, {"lobe-estimate-printed"});
  CHECK(report.passed());
  CHECK(std::ranges::any_of(report.results(), [](const verify::Result& result) {
    return result.note.starts_with("biased, as printed in CW 197: loses 2");
  }));
}

TEST_CASE("verify: wrong kernels fail the checks for them", "[slow]") {
  struct Mistake {
    std::string strategy, file, from, to, check;
  };
  const Mistake mistakes[] = {
      {"exact", "phong/strategies/exact.cl", "Vec3 v = cosine_power_direction(m.exponent + 1.0f,",
       "Vec3 v = cosine_power_direction(m.exponent,", "directions"},
      {"mixture", "phong/one_part.cl", "* (m.exponent + 1.0f) / (m.exponent + 2.0f)", "", "densities"},
      {"cosine", "math/directions.h", "polar_direction(sqrt(1.0f - u1), sqrt(u1), u2)",
       "polar_direction(sqrt((1.0f - u1) * (1.0f + u1)), u1, u2)", "jacobian"},
      {"lobe-ks", "lobes/material.cl", "vec_scale(inverse_survival, s.weight)", "s.weight", "means"},
  };
  for (const Mistake& m : mistakes) {
    CAPTURE(m.strategy, m.to);
    const KernelCopy copy(m.file, m.from, m.to);
    const verify::Report report = run_quick(16, {m.strategy}, sources::KernelFiles(copy.folder()));
    CHECK_FALSE(report.passed());
    CHECK(fails(report, m.check));
  }
}
