// Finite differences of a sampler over two of its random numbers.
#pragma once

#include <vector>

#include "measure/device_model.h"
#include "verify/model.h"

namespace phlux::verify {

/// Step in the two numbers, a multiple of 2^-23, the resolution of uniform_real.
inline constexpr double difference_step = 0x1p-7;

struct NumberPair {
  double u1, u2;
};
/// Points away from 0 and 1, where maps of the unit square have singular derivatives, and from the diagonals,
/// where the map to the disk is not smooth.
[[nodiscard]] std::vector<NumberPair> inner_points();

/// Samples of a stencil: the point itself, then steps of u1, then steps of u2.
inline constexpr std::size_t stencil_size = 9;
/// Appends the random words of a stencil: `others`, with u1 as word_1 and u2 as word_2.
void append_stencil(std::vector<Words>& words, const NumberPair& point, const Words& others,
                    std::size_t word_1, std::size_t word_2);

/// Solid angle per du1 du2, by fourth-order differences of a stencil's samples.
[[nodiscard]] double jacobian(const Sample* stencil);
/// The same by second-order differences over `steps` steps, 1 or 2; differs from jacobian() where the map is
/// not smooth.
[[nodiscard]] double coarse_jacobian(const Sample* stencil, int steps);

} // namespace phlux::verify
