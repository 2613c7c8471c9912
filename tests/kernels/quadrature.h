// Quadrature in float64 over the sphere of directions, in cells that a histogram of samples can share.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace device_test {

struct Node {
  glm::dvec3 direction;
  double weight; ///< solid angle that it stands for
  std::size_t cell;
};

/// Nodes and weights of Gauss and Legendre's rule on [from, to].
template<unsigned points, typename Visit>
void gauss_legendre(double from, double to, const Visit& visit) {
  using Rule = boost::math::quadrature::gauss<double, points>;
  const double middle = (from + to) / 2, half = (to - from) / 2;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    const double x = Rule::abscissa()[i], weight = Rule::weights()[i] * half;
    visit(middle + half * x, weight);
    if (x != 0) visit(middle - half * x, weight);
  }
}

/// The sphere cut by angles from an axis, by longitudes about it, and by the horizon. The surface's normal is
/// z.
class SphereGrid {
public:
  static constexpr int longitudes = 12;

  /// `cuts`: angles in (0, pi) at which a density may have a kink or varies rapidly.
  SphereGrid(const glm::dvec3& axis, std::vector<double> cuts) : z_(axis), angles_(std::move(cuts)) {
    const glm::dvec3 normal(0, 0, 1);
    const glm::dvec3 away = axis * axis.z - normal; // from the normal, across the axis
    x_ = glm::length(away) > 1e-9 ? glm::normalize(away) : glm::dvec3(1, 0, 0);
    y_ = glm::cross(z_, x_);
    const double tilt = std::acos(std::clamp(axis.z, -1.0, 1.0));
    constexpr double pi = std::numbers::pi;
    for (const double cut : {0.0, pi, pi / 2, pi / 2 - tilt, pi / 2 + tilt}) angles_.push_back(cut);
    for (int i = 1; i < 6; ++i) angles_.push_back(pi / 6 * i);
    std::sort(angles_.begin(), angles_.end());
    angles_.erase(std::remove_if(angles_.begin(), angles_.end(), [](double a) { return a < 0 || a > pi; }),
                  angles_.end());
    const auto too_close = [](double a, double b) { return b - a < 1e-9; };
    angles_.erase(std::unique(angles_.begin(), angles_.end(), too_close), angles_.end());
  }

  [[nodiscard]] std::size_t cells() const { return (angles_.size() - 1) * longitudes * 2; }

  [[nodiscard]] std::size_t cell_of(const glm::dvec3& direction) const {
    const double x = glm::dot(direction, x_), y = glm::dot(direction, y_), z = glm::dot(direction, z_);
    const auto above =
        std::upper_bound(angles_.begin() + 1, angles_.end() - 1, std::atan2(std::hypot(x, y), z));
    const auto ring = static_cast<std::size_t>(above - angles_.begin() - 1);
    double turn = std::atan2(y, x) / (2 * std::numbers::pi);
    if (turn < 0) turn += 1;
    const auto sector = std::min(static_cast<std::size_t>(turn * longitudes), std::size_t(longitudes - 1));
    return cell(ring, sector, direction.z > 0);
  }

  [[nodiscard]] std::vector<Node> nodes() const {
    std::vector<Node> list;
    for (std::size_t ring = 0; ring + 1 < angles_.size(); ++ring)
      gauss_legendre<10>(angles_[ring], angles_[ring + 1], [&](double angle, double weight) {
        add_circle(list, ring, angle, weight * std::sin(angle));
      });
    return list;
  }

private:
  static std::size_t cell(std::size_t ring, std::size_t sector, bool above) {
    return (ring * longitudes + sector) * 2 + (above ? 1 : 0);
  }

  [[nodiscard]] glm::dvec3 direction(double angle, double longitude) const {
    return std::sin(angle) * (std::cos(longitude) * x_ + std::sin(longitude) * y_) + std::cos(angle) * z_;
  }

  void add_circle(std::vector<Node>& list, std::size_t ring, double angle, double weight) const {
    constexpr double pi = std::numbers::pi;
    std::vector<double> cuts;
    for (int i = 0; i <= longitudes; ++i) cuts.push_back(2 * pi * i / longitudes);
    // Where the circle crosses the horizon (x_ points down, y_ lies in it), and the horizon's mirror image
    // about the axis, where folded densities jump.
    const double horizon = z_.z * std::cos(angle) / (std::max(-x_.z, 1e-300) * std::sin(angle));
    if (std::abs(horizon) < 1) {
      const double turn = std::acos(horizon);
      for (const double cut : {turn, 2 * pi - turn, pi - turn, pi + turn}) cuts.push_back(cut);
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double middle = (cuts[i] + cuts[i + 1]) / 2;
      const auto sector =
          std::min(static_cast<std::size_t>(middle / (2 * pi) * longitudes), std::size_t(longitudes - 1));
      const std::size_t here = cell(ring, sector, direction(angle, middle).z > 0);
      gauss_legendre<7>(cuts[i], cuts[i + 1], [&](double longitude, double width) {
        list.push_back({direction(angle, longitude), weight * width, here});
      });
    }
  }

  glm::dvec3 x_, y_, z_;
  std::vector<double> angles_;
};

/// Angles that contain given shares of the integral of a lobe of this exponent.
inline std::vector<double> lobe_cuts(double exponent) {
  std::vector<double> cuts;
  for (const double outside : {0.8, 0.5, 0.25, 0.1, 0.02, 1e-3, 1e-5})
    cuts.push_back(std::acos(std::pow(outside, 1 / (exponent + 1))));
  return cuts;
}

} // namespace device_test
