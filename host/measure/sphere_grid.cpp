#include "measure/sphere_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>
#include <glm/geometric.hpp>

namespace phlux::measure {
namespace {

constexpr double pi = std::numbers::pi;

std::size_t cell_number(std::size_t ring, std::size_t sector, bool above) {
  return (ring * SphereGrid::longitudes + sector) * 2 + (above ? 1 : 0);
}

std::size_t sector_of(double longitude) {
  const auto sector = static_cast<std::size_t>(longitude / (2 * pi) * SphereGrid::longitudes);
  return std::min(sector, std::size_t(SphereGrid::longitudes - 1));
}

} // namespace

template<std::size_t points>
std::array<std::array<double, 2>, points> gauss_nodes(double from, double to) {
  using Rule = boost::math::quadrature::gauss<double, points>;
  std::array<std::array<double, 2>, points> nodes;
  std::size_t next = 0;
  const double middle = (from + to) / 2, half = (to - from) / 2;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    const double x = Rule::abscissa()[i], weight = Rule::weights()[i] * half;
    nodes[next++] = {middle + half * x, weight};
    if (x != 0) nodes[next++] = {middle - half * x, weight};
  }
  return nodes;
}
template std::array<std::array<double, 2>, 4> gauss_nodes<4>(double, double);
template std::array<std::array<double, 2>, 7> gauss_nodes<7>(double, double);
template std::array<std::array<double, 2>, 10> gauss_nodes<10>(double, double);

SphereGrid::SphereGrid(const Direction& axis, std::vector<double> cuts)
    : z_(glm::normalize(axis)), angles_(std::move(cuts)) {
  const Direction away = z_ * z_.z - Direction(0, 0, 1);
  x_ = glm::length(away) > 1e-9 ? glm::normalize(away) : Direction(1, 0, 0);
  y_ = glm::cross(z_, x_);
  const double tilt = std::acos(std::clamp(z_.z, -1.0, 1.0));
  for (const double cut : {0.0, pi, pi / 2, pi / 2 - tilt, pi / 2 + tilt}) angles_.push_back(cut);
  for (int i = 1; i < 6; ++i) angles_.push_back(pi / 6 * i);
  std::sort(angles_.begin(), angles_.end());
  std::erase_if(angles_, [](double a) { return a < 0 || a > pi; });
  const auto too_close = [](double a, double b) { return b - a < 1e-9; };
  angles_.erase(std::unique(angles_.begin(), angles_.end(), too_close), angles_.end());
}

std::size_t SphereGrid::cell_of(const Direction& d) const {
  const double x = glm::dot(d, x_), y = glm::dot(d, y_), z = glm::dot(d, z_);
  const auto beyond =
      std::upper_bound(angles_.begin() + 1, angles_.end() - 1, std::atan2(std::hypot(x, y), z));
  const double longitude = std::atan2(y, x);
  return cell_number(static_cast<std::size_t>(beyond - angles_.begin() - 1),
                     sector_of(longitude < 0 ? longitude + 2 * pi : longitude), d.z > 0);
}

SphereGrid::Bounds SphereGrid::bounds(std::size_t cell) const {
  const std::size_t ring = cell / 2 / longitudes, sector = cell / 2 % longitudes;
  const double step = 2 * pi / longitudes;
  return {angles_[ring], angles_[ring + 1], step * static_cast<double>(sector),
          step * static_cast<double>(sector + 1), cell % 2 == 1};
}

std::vector<Node> SphereGrid::nodes() const {
  std::vector<Node> list;
  for (std::size_t ring = 0; ring + 1 < angles_.size(); ++ring)
    for (const auto& [angle, weight] : gauss_nodes<10>(angles_[ring], angles_[ring + 1]))
      add_circle(list, ring, angle, weight * std::sin(angle));
  return list;
}

Direction SphereGrid::direction(double angle, double longitude) const {
  return std::sin(angle) * (std::cos(longitude) * x_ + std::sin(longitude) * y_) + std::cos(angle) * z_;
}

void SphereGrid::add_circle(std::vector<Node>& list, std::size_t ring, double angle, double weight) const {
  std::vector<double> cuts;
  for (int i = 0; i <= longitudes; ++i) cuts.push_back(2 * pi * i / longitudes);
  // Intersections with the horizon (x_ points down, y_ lies in it) and with its mirror image about the axis.
  const double horizon = z_.z * std::cos(angle) / (std::max(-x_.z, 1e-300) * std::sin(angle));
  if (std::abs(horizon) < 1) {
    const double turn = std::acos(horizon);
    for (const double cut : {turn, 2 * pi - turn, pi - turn, pi + turn}) cuts.push_back(cut);
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double middle = (cuts[i] + cuts[i + 1]) / 2;
    const std::size_t cell = cell_number(ring, sector_of(middle), direction(angle, middle).z > 0);
    for (const auto& [longitude, width] : gauss_nodes<7>(cuts[i], cuts[i + 1]))
      list.push_back({direction(angle, longitude), weight * width, cell});
  }
}

std::vector<double> lobe_cuts(double exponent) {
  std::vector<double> cuts;
  for (const double outside : {0.8, 0.5, 0.25, 0.1, 0.02, 1e-3, 1e-5})
    cuts.push_back(std::acos(std::pow(outside, 1 / (exponent + 1))));
  return cuts;
}

} // namespace phlux::measure
