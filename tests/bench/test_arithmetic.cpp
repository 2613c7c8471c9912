// `phlux bench arithmetic` measures the known errors of accurate and of inaccurate formulas.
#include <cmath>

#include <catch2/catch.hpp>

#include "bench/arithmetic/arithmetic.h"
#include "bench/common/case.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/saved_table.h"
#include "kernel_copy.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::bench;

namespace {

constexpr std::size_t values = 1 << 14;

const device::Device& test_device() {
  static const device::Device device = device::open_devices({}).front();
  return device;
}

const ArithmeticKernels& kernels() {
  static const ArithmeticKernels kernels(test_device(), {}, test_device().info.lanes);
  return kernels;
}

FormulaErrors errors_of(const ArithmeticKernels& of, const std::string& kernel, double exponent = 0) {
  for (const FormulaGroup& group : formula_groups())
    for (const Formula& formula : group.formulas)
      if (formula.kernel == kernel) return of.errors(group, formula, exponent, values, 1);
  FAIL("no formula " << kernel);
  return {};
}

FormulaErrors errors_of(const std::string& kernel, double exponent = 0) {
  return errors_of(kernels(), kernel, exponent);
}

} // namespace

TEST_CASE("Power of the lobe: pow loses digits as n grows, log1p of the chord does not") {
  // 3e-4 at n = 1e4 and 3e-2 at 1e6 against 8e-8.
  CHECK(errors_of("lobe_pow", 1e4).rms_relative == Approx(3.4e-4).epsilon(.3));
  CHECK(errors_of("lobe_pow", 1e6).rms_relative == Approx(3.4e-2).epsilon(.3));
  for (const double exponent : {10., 100., 1e4, 1e6}) {
    CAPTURE(exponent);
    CHECK(errors_of("lobe_exp_log1p", exponent).rms_relative < 1.5e-7);
    CHECK(errors_of("lobe_own_log1p", exponent).rms_relative < 2.5e-7);
  }
}

TEST_CASE("Sine of a lobe sample: the textbook formula returns 0 for large n, expm1 stays accurate") {
  CHECK(errors_of("sine_pow", 1e6).largest_relative == 1); // sin(alpha) = 0
  for (const double exponent : {10., 100., 1e4, 1e6}) {
    CAPTURE(exponent);
    CHECK(errors_of("sine_expm1", exponent).largest_relative < 3e-7);
    CHECK(errors_of("sine_own", exponent).largest_relative < 6e-7);
  }
}

TEST_CASE("The formulas in the kernels are as accurate as their comments say") {
  CHECK(errors_of("turns_own").largest_ulp < 2);
  CHECK(errors_of("frame_duff").largest_relative < 4e-7);
  CHECK(errors_of("frame_frisvad").largest_relative > 1e-3);
  CHECK(errors_of("offset_scaled").failed == 0);
  CHECK(errors_of("offset_fixed").failed > 0);
  CHECK(errors_of("offset_scaled").largest_relative < 4e-6);
}

TEST_CASE("Our own polynomials have the errors of their fits") {
  CHECK(errors_of("function_own_log").largest_ulp < 4);
  CHECK(errors_of("function_own_log1p").largest_ulp < 5);
  CHECK(errors_of("function_own_expm1").largest_ulp < 4);
  CHECK(errors_of("function_own_exp2").largest_ulp < 32);
}

TEST_CASE("A formula with a wrong coefficient has larger errors") {
  const KernelCopy copy("measure/arithmetic.cl", "(Real)(-7.21347332e-01f)", "(Real)(-7.21447332e-01f)");
  const ArithmeticKernels worse(test_device(), sources::KernelFiles(copy.folder()), test_device().info.lanes);
  CHECK(errors_of(worse, "function_own_log").largest_relative >
        50 * errors_of("function_own_log").largest_relative);
  CHECK(errors_of(worse, "function_log").largest_relative == errors_of("function_log").largest_relative);
}

TEST_CASE("Every formula has a row, and each group has one formula that the kernels use") {
  for (const FormulaGroup& group : formula_groups()) {
    CAPTURE(group.name);
    CHECK(std::count_if(group.formulas.begin(), group.formulas.end(),
                        [](const Formula& f) { return f.used; }) == 1);
  }
  const TemporaryFolder folder;
  ArithmeticOptions options;
  options.folder = folder.path();
  options.quick = true;
  write_arithmetic_table(options);
  std::size_t expected = 0;
  for (const FormulaGroup& group : formula_groups())
    for (const Formula& formula : group.formulas)
      expected += kernels().has(formula) ? group.exponents.size() : 0;
  const SavedTable table(folder.path(), "arithmetic.csv", arithmetic_columns());
  REQUIRE(table.rows().size() == expected);
  for (const SavedTable::Row& row : table.rows()) {
    CAPTURE(table.value(row, "formula"));
    const double typical = std::stod(table.value(row, "rms_relative")),
                 largest = std::stod(table.value(row, "largest_relative"));
    CHECK((0 <= typical && typical <= largest * 1.001));
    CHECK(std::stod(table.value(row, "ns_least")) <= std::stod(table.value(row, "ns_per_value")));
    CHECK(std::stod(table.value(row, "ns_per_value")) <= std::stod(table.value(row, "ns_most")));
  }
}
