// Accuracy against speed of the formulas that the kernels use and of others that they could.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/arithmetic/formulas.h"
#include "bench/common/options.h"
#include "device/program.h"

namespace phlux::bench {

struct ArithmeticOptions : CommonOptions {
  bool quick = false;
  std::uint32_t seed = 1;
};

/// Errors of a formula over many elements; ulp: units in the last place of what they are relative to.
struct FormulaErrors {
  double largest_relative = 0, rms_relative = 0, largest_ulp = 0, rms_ulp = 0;
  std::size_t failed = 0, values = 0; ///< not finite, or on the wrong side
};

class ArithmeticKernels {
public:
  /// Builds kernels/arithmetic.cl, without the native_ functions where the device's compiler has none.
  /// @throws DeviceError
  ArithmeticKernels(const device::Device& device, const sources::KernelFiles& files, int lanes);

  [[nodiscard]] bool has(const Formula& formula) const { return native_ || !formula.native; }
  [[nodiscard]] FormulaErrors errors(const FormulaGroup& group, const Formula& formula, double exponent,
                                     std::size_t values, std::uint32_t seed) const;
  /// Of one value, by the device's clock: the loop of a kernel of arithmetic.cl, its own cost included.
  [[nodiscard]] double nanoseconds(const FormulaGroup& group, const std::string& kernel, double exponent,
                                   std::size_t values) const;

private:
  [[nodiscard]] double run(const std::string& kernel, const FormulaGroup& group,
                           const std::vector<float>& inputs, double exponent, int repeats,
                           std::vector<float>& outputs) const;

  device::Device device_;
  int lanes_;
  bool native_ = true;
  cl::Program program_;
};

[[nodiscard]] const std::vector<std::string>& arithmetic_columns();

/// Measures and writes arithmetic.csv as it goes. @throws DeviceError, WriteError
void write_arithmetic_table(const ArithmeticOptions& options);

/// The table, then its charts and its section of the report. @throws as the above
void measure_arithmetic(const ArithmeticOptions& options);

} // namespace phlux::bench
