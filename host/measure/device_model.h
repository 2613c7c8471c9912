// Reflectance models as a device evaluates and samples them, without a scene: kernels/measure/verify.cl. For
// `phlux verify` and the tests of the kernels.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "measure/directions.h"
#include "measure/material_program.h"

namespace phlux::measure {

struct Sample {
  Direction direction;
  Rgb weight;
  double density = 0;
  bool survives = true;
  int draws = 0;
  bool delta = false; ///< sampled from a delta distribution
};

struct Pair {
  Direction a, b;
};
struct PairValues {
  Rgb value, reversed;                      ///< f_r of (a, b), and of (b, a)
  double density = 0, reversed_density = 0; ///< of b with a fixed, and of a with b fixed
  double reverse = 0, reversed_reverse = 0; ///< reverse densities of the two calls: of a, and of b
};

/// The random words of a sampler: one for roulette and the choice of a lobe, two for the direction, one for
/// further use by the strategy.
using Words = std::array<std::uint32_t, 4>;

/// The word for which the kernels' uniform_real gives the value nearest to u in (0, 1).
[[nodiscard]] std::uint32_t word_for(double u);

class DeviceModel {
public:
  /// Builds the kernels for models of `materials`, a strategy of the Phong model and WIDTH `lanes`.
  /// @throws DeviceError
  DeviceModel(const device::Device& device, const sources::KernelFiles& files, int lanes,
              const std::string& strategy, const std::vector<scene::Material>& materials,
              std::map<std::string, std::string> defines = {});

  /// `count` samples of the sequence `seed`, from its path `first` on; `material` is an index into the
  /// materials.
  [[nodiscard]] std::vector<Sample> sample(int material, const Direction& fixed, std::size_t count,
                                           std::uint32_t seed, bool roulette, std::uint32_t first = 0) const;
  /// One sample for each set of random words.
  [[nodiscard]] std::vector<Sample> drive(int material, const Direction& fixed,
                                          const std::vector<Words>& words, bool roulette) const;
  [[nodiscard]] std::vector<PairValues> evaluate(int material, const std::vector<Pair>& pairs) const;
  [[nodiscard]] std::vector<Rgb> reflectivity(int material, const std::vector<Direction>& directions) const;
  /// For directions with these cosines in the plane of x and z.
  [[nodiscard]] std::vector<Rgb> reflectivity(int material, const std::vector<double>& cosines) const;

private:
  /// A plane's length: the lanes of whole groups.
  [[nodiscard]] std::size_t plane_of(std::size_t elements) const;
  /// Planes 0, 1, ... of `values` per element; the last element repeats to the end of a plane.
  template<typename Value>
  [[nodiscard]] cl::Buffer planes(std::size_t elements, std::size_t values, const Value& value) const;
  template<typename... Arguments>
  [[nodiscard]] std::vector<Sample> run_samples(const char* kernel, int material, const Direction& fixed,
                                                std::size_t elements, const Arguments&... arguments) const;

  MaterialProgram program_;
};

} // namespace phlux::measure
