// One strategy of kernels/phong.cl at work on its own: no scene, no rays, radiance 1 from everywhere.
#pragma once

#include <cstdint>
#include <string>

#include "bench/moments.h"
#include "bench/phong_program.h"

namespace phlux::bench {

/// Directions that `rejection` proposes for each that it takes: the bound of f_r cos over rho.
[[nodiscard]] double rejection_proposals(const Case& one);

/// Whether the strategy absorbs by Russian roulette, as CW 197, 3.3.2 has it; those that know nothing of the
/// lobes do not.
[[nodiscard]] bool has_roulette(const std::string& strategy);

class Sampler {
public:
  /// Builds kernels/sampling.cl for one strategy (render::strategy_names()) and WIDTH. @throws DeviceError
  Sampler(const device::Device& device, const device::KernelFiles& files, const std::string& strategy,
          int lanes);

  struct Run {
    PowerSums sums;
    std::uint64_t rays = 0;    ///< samples that survive and point above the surface
    std::uint64_t draws = 0;   ///< directions that were drawn
    std::uint64_t defects = 0; ///< samples that are wrong by themselves: not unit, no density, not finite
    double seconds = 0;        ///< of the kernels, by the device's clock

    void add(const Run& other);
  };

  /// At least `samples` samples, a whole number of blocks in each lane; `first` numbers the first sample of
  /// each lane in the seed's sequence. The material's tables stay on the device from one call to the next.
  /// @throws DeviceError
  [[nodiscard]] Run run(const Case& one, std::uint64_t samples, cl_uint2 seed, std::uint32_t first = 0);

  /// Samples in each lane that a call of run() with so many samples takes.
  [[nodiscard]] std::uint32_t samples_per_lane(std::uint64_t samples) const;
  [[nodiscard]] const std::string& strategy() const { return strategy_; }

private:
  [[nodiscard]] std::uint64_t blocks(std::uint64_t samples) const;
  void prepare(const Case& one);

  PhongProgram program_;
  std::string strategy_;
  std::size_t items_, local_;
  cl::Kernel kernel_;
  Case prepared_{-1, 0, 0, 0};
  cl::Buffer directions_;
};

} // namespace phlux::bench
