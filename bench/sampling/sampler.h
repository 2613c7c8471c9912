// One strategy of kernels/phong.cl at work on its own: no scene, no rays, one kind of light.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/common/moments.h"
#include "bench/common/phong_program.h"
#include "bench/sampling/radiance.h"

namespace phlux::bench {

/// Directions that `rejection` proposes for each that it takes: the bound of f_r cos over rho.
[[nodiscard]] double rejection_proposals(const Case& one);

/// The printed estimate of CW 197, 3.3.1 (`lobe-estimate-printed`) is 0 for a share of its samples, those of
/// the lobe that fall below the surface: this share of the specular part is lost.
[[nodiscard]] double printed_loss(const Case& one);

/// And it has this density (per unit of height) at heights just above 0. A sample drawn with probability e
/// weighs 1 / e, so where the density is not 0 the variance diverges as the integral of 1 / e does.
[[nodiscard]] double printed_density_at_horizon(const Case& one);

/// Whether the strategy absorbs by Russian roulette, as CW 197, 3.3.2 has it; those that know nothing of the
/// lobes do not.
[[nodiscard]] bool has_roulette(const std::string& strategy);

/// What one row of a table measures.
struct Subject {
  Case one;
  Light light = Light::constant;
  bool roulette = false; ///< absorption; meant for strategies that have it, possible for all
  double reflected = 0;  ///< reflected_radiance(one, light)
  cl_uint2 seed = {{0, 0}};
};

class Sampler {
public:
  /// Builds kernels/sampling.cl for one strategy (render::strategy_names()) and WIDTH. @throws DeviceError
  Sampler(const device::Device& device, const sources::KernelFiles& files, const std::string& strategy,
          int lanes);

  /// A number that changes with the kernels of these strategies.
  [[nodiscard]] static std::string kernels_fingerprint(const sources::KernelFiles& files,
                                                       const std::vector<std::string>& strategies, int lanes);

  struct Run {
    PowerSums sums;
    std::uint64_t rays = 0;    ///< samples that survive and point above the surface
    std::uint64_t draws = 0;   ///< directions that were drawn
    std::uint64_t defects = 0; ///< samples that are wrong by themselves: not unit, no density, not finite
    double seconds = 0;        ///< of the kernels, by the device's clock
    double wall_seconds = 0;   ///< of the kernels, from the enqueueing thread's side

    void add(const Run& other);
  };

  /// At least `samples` samples, a whole number of blocks in each lane; `first` numbers the first sample of
  /// each lane in the seed's sequence. The material's tables stay on the device from one call to the next.
  /// @throws DeviceError
  [[nodiscard]] Run run(const Subject& subject, std::uint64_t samples, std::uint32_t first = 0);

  /// The same of the reflectivity, with roulette where the strategy has it.
  [[nodiscard]] Run run(const Case& one, std::uint64_t samples, cl_uint2 seed, std::uint32_t first = 0);

  /// Samples in each lane that a call of run() with so many samples takes.
  [[nodiscard]] std::uint32_t samples_per_lane(std::uint64_t samples) const;
  [[nodiscard]] const std::string& strategy() const { return strategy_; }

private:
  struct Blocks {
    std::uint64_t count, size; ///< in each lane; samples of each
  };
  [[nodiscard]] Blocks blocks(std::uint64_t samples) const;
  void prepare(const Case& one);

  PhongProgram program_;
  std::string strategy_;
  std::size_t items_, local_;
  cl::Kernel kernel_;
  Case prepared_{-1, 0, 0, 0};
  cl::Buffer directions_;
};

} // namespace phlux::bench
