#include <set>

#include <glm/geometric.hpp>

#include "verify/finite_differences.h"
#include "verify/lobe/checks.h"

namespace phlux::verify {
namespace {

// Error of differences where the map is smooth; larger than the probability of a part that words_used may
// miss.
constexpr double jacobian_error = 0.02;
constexpr double moved = 1e-6; // smallest change of a direction

// The indices of the random words that directions depend on.
std::set<std::size_t> words_used(const LobeSubject& subject, const LobeCase& one) {
  std::vector<Words> words;
  constexpr std::size_t steps = 64; // from 0 to 1 inclusive: a choice between parts may be at either end
  constexpr std::size_t variants = 4 * (steps + 1);
  for (const double u : {0.21, 0.48, 0.79})
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t step = 0; step <= steps; ++step) {
        words.push_back({word_for(u), word_for(0.9 * u), word_for(1.1 * u), word_for(1 - u)});
        words.back()[k] = word_for(static_cast<double>(step) / steps);
      }
  const auto samples = subject.device.drive(one.material, one.fixed, words, false);
  std::set<std::size_t> used;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t k = i % variants / (steps + 1), first = i - i % (steps + 1);
    if (samples[i].delta || samples[i].draws != 1 ||
        !(glm::length(samples[i].direction - samples[first].direction) <= moved))
      used.insert(k);
  }
  return used;
}

// Whether another part of the unit square has samples near that of a point, so that the map covers directions
// twice. The numbers may be longitudes, which wrap around.
bool is_covered_twice(const std::vector<Sample>& grid, int side, const NumberPair& point, const Sample& at,
                      double spacing) {
  const auto far_apart = [](double a, double b) {
    const double off = std::abs(a - b);
    return std::min(off, 1 - off) > 0.15;
  };
  for (int i = 0; i < side * side; ++i) {
    const double u1 = (i / side + 0.5) / side, u2 = (i % side + 0.5) / side;
    if ((far_apart(u1, point.u1) || far_apart(u2, point.u2)) &&
        glm::length(grid[static_cast<std::size_t>(i)].direction - at.direction) < spacing)
      return true;
  }
  return false;
}

// The same point with other values of the words that directions do not depend on elsewhere: a part that is
// chosen with a small probability may still be there, and the density is then that of a choice.
std::vector<Words> chosen_otherwise(const NumberPair& point, std::size_t first, std::size_t second) {
  std::vector<Words> list;
  for (const double u : {0.01, 0.99}) {
    list.push_back({word_for(u), word_for(u), word_for(u), word_for(u)});
    list.back()[first] = word_for(point.u1);
    list.back()[second] = word_for(point.u2);
  }
  return list;
}

// Relative error of the density, or nothing where differences of different steps show that the map is not
// smooth.
std::optional<double> density_error(const LobeSubject& subject, const Sample* stencil) {
  constexpr double smooth = 0.02;
  for (std::size_t i = 0; i < stencil_size; ++i)
    if (stencil[i].delta || !is_finite(stencil[i].direction) || !subject.counts(stencil[i]))
      return std::nullopt;
  const double fine = jacobian(stencil), coarse = coarse_jacobian(stencil, 1),
               coarser = coarse_jacobian(stencil, 2);
  if (!(fine > 0) || std::max(std::abs(coarse - fine), std::abs(coarser - fine)) > smooth * fine)
    return std::nullopt;
  return std::abs(stencil->density * fine - 1);
}

} // namespace

void check_map(const LobeSubject& subject, const LobeCase& one) {
  const std::set<std::size_t> used = words_used(subject, one);
  if (used.size() != 2) return; // the sampler chooses among several maps, or draws until a sample is accepted
  const std::size_t first = *used.begin(), second = *used.rbegin();
  const Words others{word_for(0.5), word_for(0.5), word_for(0.5), word_for(0.5)};
  std::vector<Words> words;
  for (const NumberPair& p : inner_points()) append_stencil(words, p, others, first, second);
  const std::size_t stencils = words.size() / stencil_size;
  for (const NumberPair& p : inner_points())
    for (const Words& other : chosen_otherwise(p, first, second)) words.push_back(other);
  constexpr int side = 48;
  for (int i = 0; i < side * side; ++i) {
    words.push_back(others);
    words.back()[first] = word_for((i / side + 0.5) / side);
    words.back()[second] = word_for((i % side + 0.5) / side);
  }
  const auto samples = subject.device.drive(one.material, one.fixed, words, false);
  const std::vector<Sample> grid(samples.end() - side * side, samples.end());
  double worst = 0;
  std::size_t smooth = 0;
  for (std::size_t i = 0; i < stencils; ++i) {
    const Sample* stencil = &samples[i * stencil_size];
    const Sample* otherwise = &samples[stencils * stencil_size + 2 * i];
    const bool is_chosen = std::max(glm::length(otherwise[0].direction - stencil->direction),
                                    glm::length(otherwise[1].direction - stencil->direction)) > moved;
    const auto error = density_error(subject, stencil);
    if (!error || is_chosen) continue;
    const double spacing = std::sqrt(jacobian(stencil)) / side;
    if (*error > jacobian_error && is_covered_twice(grid, side, inner_points()[i], *stencil, spacing)) return;
    worst = std::max(worst, *error);
    ++smooth;
  }
  if (2 * smooth >= stencils) subject.record("jacobian", worst, jacobian_error, one.where);
}

} // namespace phlux::verify
