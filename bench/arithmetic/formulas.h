// The formulas of kernels/arithmetic.cl: what they compute, from what, and what is right.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

namespace phlux::bench {

struct Formula {
  std::string kernel, name; ///< without commas
  bool used = false;        ///< by phlux's kernels
  bool native = false;      ///< of OpenCL's native_ functions
};

/// Formulas for the same thing.
struct FormulaGroup {
  std::string name, what; ///< "lobe", "cos^n of the angle between two directions"
  std::size_t inputs = 1, outputs = 1;
  std::vector<double> exponents; ///< {0} where there is none
  std::vector<Formula> formulas;

  using Random = std::mt19937_64;
  /// One element's inputs, which are then rounded to float32, and after them `hidden` values that only the
  /// error sees.
  std::function<void(Random&, double exponent, double* inputs)> draw;

  struct Error {
    double absolute = 0, scale = 1; ///< relative to this
    bool failed = false;            ///< of offsets: the position is still on the wrong side
  };
  /// Of one element, against float64.
  std::function<Error(const double* inputs, double exponent, const float* outputs)> error;
  std::size_t hidden = 0;
};

[[nodiscard]] const std::vector<FormulaGroup>& formula_groups();

} // namespace phlux::bench
