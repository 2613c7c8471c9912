#include "bench/sampling/quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>

namespace phlux::bench {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int points = 5; // of the rule, in each dimension
constexpr int first_rows = 16, first_columns = 32;
constexpr double relative_tolerance = 1e-7;
constexpr double peak_width = 3e-3; // radians; a lobe of exponent 1e6 is 1e-3 wide
constexpr int most_levels = 14;     // the smallest cells are 6e-6 wide

struct Cell {
  double theta, phi, height, width; // from (theta, phi)
  double integral = 0;
  double parent = 0; // integral of the cell of which it is a quarter
};

// Abscissas and weights on [0, 1].
std::array<std::array<double, 2>, points> gauss_rule() {
  using Rule = boost::math::quadrature::gauss<double, points>;
  std::array<std::array<double, 2>, points> rule{};
  std::size_t next = 0;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) // those that are not negative
    for (const double sign : {1.0, -1.0}) {
      if (sign < 0 && Rule::abscissa()[i] == 0) continue;
      rule.at(next++) = {0.5 + sign * 0.5 * Rule::abscissa()[i], 0.5 * Rule::weights()[i]};
    }
  return rule;
}

// All cells in one call of `evaluate`.
void integrate(const Evaluation& evaluate, std::vector<Cell>& cells) {
  static const auto rule = gauss_rule();
  std::vector<float> directions;
  directions.reserve(cells.size() * points * points * 3);
  for (const Cell& cell : cells)
    for (const auto& [u, unused_u] : rule)
      for (const auto& [v, unused_v] : rule) {
        const double theta = cell.theta + u * cell.height, phi = cell.phi + v * cell.width;
        for (const double x :
             {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)})
          directions.push_back(static_cast<float>(x));
      }
  const std::vector<float> values = evaluate(directions);
  std::size_t next = 0;
  for (Cell& cell : cells)
    for (const auto& [u, weight_u] : rule)
      for (const auto& [v, weight_v] : rule) {
        const double theta = cell.theta + u * cell.height;
        cell.integral += weight_u * weight_v * cell.height * cell.width * std::sin(theta) * std::cos(theta) *
                         static_cast<double>(values.at(next++));
      }
}

std::vector<Cell> first_cells() {
  std::vector<Cell> cells;
  const double height = pi / 2 / first_rows, width = 2 * pi / first_columns;
  for (int row = 0; row < first_rows; ++row)
    for (int column = 0; column < first_columns; ++column)
      cells.push_back({row * height, column * width, height, width});
  return cells;
}

std::vector<Cell> quarters_of(const std::vector<Cell>& cells) {
  std::vector<Cell> quarters;
  for (const Cell& c : cells)
    for (const double down : {0.0, 0.5})
      for (const double across : {0.0, 0.5})
        quarters.push_back(
            {c.theta + down * c.height, c.phi + across * c.width, c.height / 2, c.width / 2, 0, c.integral});
  return quarters;
}

bool is_near(const Cell& cell, const std::array<double, 3>& peak) {
  const double theta = std::acos(std::clamp(peak[2], -1.0, 1.0));
  const double phi = std::atan2(peak[1], peak[0]);
  const double turned = phi < 0 ? phi + 2 * pi : phi;
  const bool pole = theta < cell.height; // where every longitude is near
  return theta >= cell.theta - cell.height && theta <= cell.theta + 2 * cell.height &&
         (pole || (turned >= cell.phi - cell.width && turned <= cell.phi + 2 * cell.width));
}

} // namespace

double hemisphere_integral(const Evaluation& evaluate, const std::vector<std::array<double, 3>>& peaks) {
  std::vector<Cell> cells = first_cells();
  integrate(evaluate, cells);
  double finished = 0;
  for (int level = 0; level < most_levels && !cells.empty(); ++level) {
    std::vector<Cell> quarters = quarters_of(cells);
    integrate(evaluate, quarters);
    double total = finished;
    for (const Cell& cell : quarters) total += cell.integral;
    cells.clear();
    for (std::size_t i = 0; i < quarters.size(); i += 4) {
      const double sum = quarters[i].integral + quarters[i + 1].integral + quarters[i + 2].integral +
                         quarters[i + 3].integral;
      const bool converged = std::abs(sum - quarters[i].parent) <= relative_tolerance * std::abs(total);
      for (std::size_t k = i; k < i + 4; ++k) {
        const bool narrow = quarters[k].height > peak_width && std::ranges::any_of(peaks, [&](const auto& p) {
                              return is_near(quarters[k], p);
                            });
        if (!converged || narrow)
          cells.push_back(quarters[k]);
        else
          finished += quarters[k].integral;
      }
    }
  }
  for (const Cell& cell : cells) finished += cell.integral;
  return finished;
}

} // namespace phlux::bench
