// Estimates the reflected radiance of a material by one way to sample its model, without a scene and without
// rays.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/sampling/radiance.h"
#include "measure/material_program.h"
#include "measure/moments.h"

namespace phlux::bench {

/// Expected number of proposals of `rejection` per sample: the bound of f_r cos(theta) over rho.
[[nodiscard]] double rejection_proposals(const Case& one);

/// The share of the specular part that the estimate printed in CW 197, 3.3.1 (`lobe-estimate-printed`) loses:
/// its estimate is 0 for samples of the lobe below the surface.
[[nodiscard]] double printed_loss(const Case& one);

/// The density (per unit of height) of that estimate's samples at height 0. A sample drawn with probability e
/// has weight 1 / e, so the variance diverges like the integral of 1 / e if this density is not 0.
[[nodiscard]] double printed_density_at_horizon(const Case& one);

/// Whether the strategy absorbs by Russian roulette (CW 197, 3.3.2) in sampling.csv: all but those that
/// ignore the lobe, which absorb in renders only (sampling-plain-roulette.csv). A model's own sampling does.
[[nodiscard]] bool has_roulette(const std::string& strategy);

/// What one row of the table estimates: an integral, with or without roulette.
struct Subject {
  Case one;
  Light light = Light::constant;
  bool roulette = false; ///< absorb paths; meant for strategies with has_roulette()
  double reflected = 0;  ///< the integral: reflected_radiance(one, light), or reflectivity_of()
  cl_uint2 seed = {{0, 0}};
};

/// The ways to sample a model other than the Phong model: its own, called by its name, cosine and uniform; of
/// anisotropicphong also exact_split, its own with the exact reflectivities of its two parts in place of
/// estimates, for the choice between them and roulette.
inline constexpr const char* exact_split = "exact-split";
[[nodiscard]] std::vector<std::string> strategies_of_model(const scene::Model& model);

class Sampler {
public:
  /// Builds kernels/measure/sampling.cl for one strategy and WIDTH. Strategies of the Phong model:
  /// render::strategy_names(); of any other: strategies_of_model(). @throws DeviceError
  Sampler(const device::Device& device, const sources::KernelFiles& files, const std::string& strategy,
          int lanes, const lobes::ModelPointer& model = lobes::shipped("phong"));

  /// A hash of the kernels of these strategies.
  [[nodiscard]] static std::string kernels_fingerprint(const sources::KernelFiles& files,
                                                       const std::vector<std::string>& strategies, int lanes,
                                                       const lobes::ModelPointer& model);

  struct Run {
    measure::PowerSums sums;
    std::uint64_t rays = 0;    ///< samples that survive roulette and are above the surface
    std::uint64_t draws = 0;   ///< directions drawn, rejected ones included
    std::uint64_t defects = 0; ///< invalid samples: not unit, density not positive, or not finite
    double seconds = 0;        ///< of the kernels: processor time on CPUs, else by the device's clock
    double wall_seconds = 0;   ///< of the kernels, by the clock of the host

    void add(const Run& other);
  };

  /// Draws at least `samples` samples: each lane draws a whole number of blocks. `first` is the number of the
  /// first sample of each lane in the sequence of the seed. @throws DeviceError
  [[nodiscard]] Run run(const Subject& subject, std::uint64_t samples, std::uint32_t first = 0);

  /// Estimates the reflectivity, with roulette if the strategy has it.
  [[nodiscard]] Run run(const Case& one, std::uint64_t samples, cl_uint2 seed, std::uint32_t first = 0);

  /// The reflectivity of the case by quadrature of f_r as the device evaluates it, the mean over channels and
  /// over the longitudes at which run() samples; relative error about 1e-6 for functions without
  /// discontinuities.
  /// @throws DeviceError
  [[nodiscard]] double reflectivity_of(const Case& one);

  /// Samples that each lane draws in a call of run() for `samples` samples.
  [[nodiscard]] std::uint32_t samples_per_lane(std::uint64_t samples) const;
  [[nodiscard]] const std::string& strategy() const { return strategy_; }

private:
  struct Blocks {
    std::uint64_t count, size; ///< blocks per lane, samples per block
  };
  [[nodiscard]] Blocks blocks(std::uint64_t samples) const;
  void prepare(const Case& one);
  [[nodiscard]] std::vector<float> words_of_exact_split(const Case& one);

  measure::MaterialProgram program_;
  std::string strategy_;
  std::size_t items_, local_;
  cl::Kernel kernel_;
  Case prepared_{-1, 0, 0, 0, nullptr};
  cl::Buffer directions_;
  std::vector<float> derived_; ///< of MaterialProgram::set_materials()
};

} // namespace phlux::bench
