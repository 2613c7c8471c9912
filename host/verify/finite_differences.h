// Finite differences of a sampler over two of its random numbers.
#pragma once

#include <vector>

#include "measure/device_model.h"
#include "verify/model.h"

namespace phlux::verify {

/// Steps in the two numbers, whole multiples of the 2^-23 that uniform_real resolves.
inline constexpr double difference_step = 0x1p-7;

struct NumberPair {
  double u1, u2;
};
/// Points away from 0 and 1, where maps of the unit square have roots, and from the diagonals, where the map
/// to the disk has edges.
[[nodiscard]] std::vector<NumberPair> inner_points();

/// Samples that the differences at one point take: the point itself, then steps of u1, then steps of u2.
inline constexpr std::size_t stencil_size = 9;
/// Appends their words: `others`, with u1 and u2 in the words of these numbers.
void append_stencil(std::vector<Words>& words, const NumberPair& point, const Words& others,
                    std::size_t word_1, std::size_t word_2);

/// Solid angle per du1 du2: differences of fourth order of a stencil's samples.
[[nodiscard]] double jacobian(const Sample* stencil);
/// The same by differences of second order over `steps` steps, 1 or 2: far from it where the map is not
/// smooth.
[[nodiscard]] double coarse_jacobian(const Sample* stencil, int steps);

} // namespace phlux::verify
