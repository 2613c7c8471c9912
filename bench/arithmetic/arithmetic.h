// Measures error and speed of the formulas that the kernels use and of alternatives.
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

/// Errors of a formula over many inputs. ulp: units in the last place of the value that the error is relative
/// to.
struct FormulaErrors {
  double largest_relative = 0, rms_relative = 0, largest_ulp = 0, rms_ulp = 0;
  std::size_t failed = 0, values = 0; ///< failed: not finite, or offsets that end on the wrong side
};

class ArithmeticKernels {
public:
  /// Builds kernels/measure/arithmetic.cl, without the native_ functions if the device compiler does not have
  /// them.
  /// @throws DeviceError
  ArithmeticKernels(const device::Device& device, const sources::KernelFiles& files, int lanes);

  [[nodiscard]] bool has(const Formula& formula) const { return native_ || !formula.native; }
  [[nodiscard]] FormulaErrors errors(const FormulaGroup& group, const Formula& formula, double exponent,
                                     std::size_t values, std::uint32_t seed) const;
  /// Time per value of the loop in a kernel of arithmetic.cl, loop overhead included, by the clock of the
  /// device.
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

/// Writes arithmetic.csv. @throws DeviceError, WriteError
void write_arithmetic_table(const ArithmeticOptions& options);

/// Writes the table, its charts and its section of the report. @throws as the above
void measure_arithmetic(const ArithmeticOptions& options);

} // namespace phlux::bench
