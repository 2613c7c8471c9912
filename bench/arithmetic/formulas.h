// The formulas of kernels/measure/arithmetic.cl, with random inputs and exact results.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

namespace phlux::bench {

struct Formula {
  std::string kernel, name; ///< no commas
  bool used = false;        ///< in the kernels of Phlux
  bool native = false;      ///< uses native_ functions of OpenCL
};

/// Formulas for the same value.
struct FormulaGroup {
  std::string name, what; ///< "lobe", "cos^n of the angle between two directions"
  std::size_t inputs = 1, outputs = 1;
  std::vector<double> exponents; ///< {0} if there is no exponent
  std::vector<Formula> formulas;

  using Random = std::mt19937_64;
  /// Draws the inputs of one element, which are then rounded to float32, and after them `hidden` values for
  /// error() only.
  std::function<void(Random&, double exponent, double* inputs)> draw;

  struct Error {
    double absolute = 0, scale = 1; ///< the relative error is absolute / scale
    bool failed = false;            ///< offsets: the position is still on the wrong side
  };
  /// The error of one element against float64.
  std::function<Error(const double* inputs, double exponent, const float* outputs)> error;
  std::size_t hidden = 0;
};

[[nodiscard]] const std::vector<FormulaGroup>& formula_groups();

} // namespace phlux::bench
