// One strategy of kernels/phong.cl at work on its own: no scene, no rays, radiance 1 from everywhere.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "bench/moments.h"
#include "device/program.h"

namespace phlux::bench {

/// A colourless material and the angle of the direction that is known.
struct Case {
  double diffuse = 0, specular = 0, exponent = 0; ///< kd, ks, n
  double degrees = 0;                             ///< from the normal, below 90
  bool operator==(const Case&) const = default;
};

/// The reflectivity rho = rho_d + rho_s, in closed form and double precision: what every strategy estimates.
[[nodiscard]] double exact_reflectivity(const Case& one);

/// Directions that `rejection` proposes for each that it takes: the bound of f_r cos over rho.
[[nodiscard]] double rejection_proposals(const Case& one);

/// Whether the strategy absorbs by Russian roulette, as CW 197, 3.3.2 has it; those that know nothing of the
/// lobes do not.
[[nodiscard]] bool has_roulette(const std::string& strategy);

/// The kernels to measure: the embedded ones where `folder` is empty.
[[nodiscard]] device::KernelFiles kernel_files(const std::filesystem::path& folder);

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

  device::Device device_;
  std::string strategy_;
  int lanes_;
  std::size_t items_, local_;
  cl::Program program_;
  cl::Kernel kernel_;
  Case prepared_{-1, 0, 0, 0};
  cl::Buffer material_, reflectivity_, directions_;
};

} // namespace phlux::bench
