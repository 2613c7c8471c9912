// The reflectance model as a device computes it, for one strategy: kernels/measure/verify.cl.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "device/program.h"
#include "lobes/program.h"
#include "verify/model.h"

namespace phlux::verify {

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

/// All combinations of the smallest and largest numbers, their neighbours, and some between; fewer if `thin`.
[[nodiscard]] std::vector<Words> extreme_words(bool thin);
/// The normal, close to the normal, grazing, in the tangent plane.
[[nodiscard]] std::vector<Direction> extreme_directions();

class DeviceModel {
public:
  /// Builds the kernels. @throws DeviceError
  DeviceModel(const device::Device& device, const sources::KernelFiles& files, int lanes,
              const std::string& strategy, const std::vector<scene::Material>& materials);

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
  // The length of a plane: `elements` rounded up to the lanes of whole work-groups.
  [[nodiscard]] std::size_t elements_of_groups(std::size_t elements) const;
  // `values` planes, one after the other, of word(element, value).
  template<class Word>
  [[nodiscard]] cl::Buffer planes(std::size_t elements, std::size_t values, const Word& word) const;
  [[nodiscard]] cl::Kernel kernel(const char* name, int material) const;
  // Runs a kernel and returns its result, which is its argument `last`.
  [[nodiscard]] std::vector<float> run(cl::Kernel& kernel, cl_uint last, std::size_t elements,
                                       std::size_t values) const;
  [[nodiscard]] std::vector<Sample> run_samples(cl::Kernel& kernel, cl_uint last, std::size_t elements) const;

  device::Device device_;
  int lanes_;
  cl::Program program_;
  cl::Buffer materials_, table_;
};

} // namespace phlux::verify
