#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scene/scene.h"
#include "verify/checks.h"

namespace phlux::verify {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double reflectivity_error = 1e-4; // relative, at every exponent and angle
constexpr double value_error = 1e-5;        // relative, of f_r where it is well conditioned
constexpr double known_error = 1e-6;        // of printed values of 8 digits

std::vector<double> exponents(bool quick) {
  std::vector<double> list{0, 0.1, 0.3, 0.5, 1, 1.5, 2, 3};
  const int per_decade = quick ? 1 : 4;
  for (int i = per_decade; i <= 6 * per_decade; ++i) list.push_back(std::pow(10.0, double(i) / per_decade));
  return list;
}

// Whole degrees or parts of them, closer together towards the horizon.
std::vector<double> angles(bool quick) {
  std::vector<double> list{0, 1e-3, 89.99, 89.999, 90};
  const int count = quick ? 90 : 270;
  for (int i = 1; i < count; ++i) list.push_back(90.0 * i / count + 0.037 * 90 / count);
  return list;
}

// f_r with both directions along the normal, and rho_s / ks (by quadrature).
struct KnownValue {
  double diffuse, specular, exponent, value;
};
constexpr KnownValue known_values[] = {
    {.5, .5, 10, 7 / (2 * pi)}, {0, 0, 10, 0}, {1, 0, 10, 1 / pi}, {0, 1, 10, 6 / pi}};
struct KnownReflectivity {
  double degrees, exponent, reflectivity;
};
constexpr KnownReflectivity known_reflectivities[] = {
    {30, 50, 0.86602540}, {60, 10, 0.50473595},  {75, 10, 0.29190102},
    {85, 50, 0.11006323}, {89, 100, 0.04912536}, {89, 1000, 0.02321229},
    {0, 10, 1},           {0, 1e6, 1},           {60, 0, 0.75}};

double cosine_of(double degrees) {
  return degrees == 90 ? 0.0 : std::cos(degrees * pi / 180);
}

} // namespace

ModelCases make_model_cases(bool quick) {
  ModelCases cases;
  cases.exponents = exponents(quick);
  std::vector<scene::Material> materials;
  for (const double n : cases.exponents) materials.push_back(lobes::phong({0, 0.3, 0.5}, {1, 0.7, 0.2}, n));
  for (const auto& known : known_values)
    materials.push_back(lobes::phong(Rgb(known.diffuse), Rgb(known.specular), known.exponent));
  for (const auto& known : known_reflectivities)
    materials.push_back(lobes::phong(Rgb(0), Rgb(1), known.exponent));
  cases.materials = materials;
  return cases;
}

namespace {

void check_reflectivity(const DeviceModel& device, const ModelCases& cases, bool quick, Report& report) {
  std::vector<double> cosines;
  for (const double degrees : angles(quick)) cosines.push_back(as_float({cosine_of(degrees), 0, 0}).x);
  for (std::size_t m = 0; m < cases.exponents.size(); ++m) {
    const auto seen = device.reflectivity(static_cast<int>(m), cosines);
    const Model model = model_of(cases.materials[m]);
    for (std::size_t i = 0; i < cosines.size(); ++i) {
      const double angle = std::acos(cosines[i]);
      const Rgb right = model.diffuse + model.specular * lobe_reflectivity(model.exponent, angle);
      const auto where = [&] {
        return fmt::format("n {:.6g}, {:.4g} degrees", model.exponent, angle * 180 / pi);
      };
      double error = 0, gain = 0;
      for (int channel = 0; channel < 3; ++channel) {
        error = std::max(error, std::abs(seen[i][channel] - right[channel]) / right[channel]);
        gain = std::max(gain, seen[i][channel]); // kd + ks is 1 in the first two channels
      }
      report.record("", "reflectivity", error, reflectivity_error, where());
      report.record("", "energy", gain, 1 + 1e-6, where());
    }
  }
}

// Pairs over the whole hemisphere, and pairs near the lobe's axis within a few of its widths.
std::vector<Pair> random_pairs(double exponent, std::size_t count) {
  std::mt19937 engine(17);
  const auto uniform = [&] { return (static_cast<double>(engine()) + 0.5) / 4294967296.0; };
  std::vector<Pair> pairs;
  while (pairs.size() < count) {
    const Direction a = as_float(polar(std::acos(uniform()), 2 * pi * uniform()));
    Direction b = polar(std::acos(uniform()), 2 * pi * uniform());
    if (pairs.size() % 2 == 0) {
      const double width = 6 * uniform() / std::sqrt(exponent + 1);
      b = glm::normalize(Direction(-a.x, -a.y, a.z) + width * (b - Direction(0, 0, 0.5)));
    }
    if (b.z > 1e-6) pairs.push_back({a, as_float(b)});
  }
  return pairs;
}

void check_values(const DeviceModel& device, const ModelCases& cases, std::size_t count, Report& report) {
  for (std::size_t m = 0; m < cases.exponents.size(); ++m) {
    const auto pairs = random_pairs(cases.exponents[m], count);
    const auto seen = device.evaluate(static_cast<int>(m), pairs);
    const Model model = model_of(cases.materials[m]);
    const std::string where = fmt::format("n {:.6g}", model.exponent);
    double asymmetry = 0, error = 0, edge = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Rgb right = value(model, pairs[i].a, pairs[i].b);
      const double condition = lobe_condition(model.exponent, pairs[i].a, pairs[i].b);
      for (int channel = 0; channel < 3; ++channel) {
        const double value = seen[i].value[channel], reversed = seen[i].reversed[channel];
        if (value != reversed)
          asymmetry = std::max(asymmetry, std::abs(value - reversed) / std::max(value, reversed));
        if (right[channel] < 1e-30) continue;
        const double off = std::abs(value - right[channel]) / right[channel];
        if (condition < well_conditioned)
          error = std::max(error, off);
        else
          edge = std::max(edge, off / edge_error(condition));
      }
    }
    report.record("", "reciprocity", asymmetry, value_error, where);
    report.record("", "value", error, value_error, where);
    report.record("", "value at edge", edge, 1, where);
  }
}

// f_r is 0 if either direction is below the surface.
void check_below(const DeviceModel& device, const ModelCases& cases, Report& report) {
  const Direction above[] = {{0, 0, 1}, as_float(polar(1.2, 0.4))},
                  below[] = {as_float(polar(1.7, 3.3)), {0, 0, -1}};
  std::vector<Pair> pairs;
  for (const Direction& a : above)
    for (const Direction& b : below) pairs.insert(pairs.end(), {{a, b}, {b, a}, {b, b}});
  for (std::size_t m = 0; m < cases.exponents.size(); ++m)
    for (const PairValues& seen : device.evaluate(static_cast<int>(m), pairs))
      report.record("", "below", glm::length(seen.value) + glm::length(seen.reversed), 0,
                    fmt::format("n {:.6g}", cases.exponents[m]));
}

void check_known(const DeviceModel& device, const ModelCases& cases, Report& report) {
  int material = static_cast<int>(cases.exponents.size());
  for (const auto& known : known_values) {
    const double seen = device.evaluate(material++, {{{0, 0, 1}, {0, 0, 1}}}).front().value.r;
    report.record("", "known values", std::abs(seen - known.value), known_error * std::max(1.0, known.value),
                  fmt::format("kd {:g}, ks {:g}, n {:g}", known.diffuse, known.specular, known.exponent));
  }
  for (const auto& known : known_reflectivities) {
    const double seen =
        device.reflectivity(material++, std::vector<double>{cosine_of(known.degrees)}).front().r;
    const std::string where = fmt::format("n {:g}, {:g} degrees", known.exponent, known.degrees);
    report.record("", "known reflectivities", std::abs(seen / known.reflectivity - 1), reflectivity_error,
                  where);
    // The quadrature, which is the reference of other checks, must agree in all digits.
    report.record("", "quadrature",
                  std::abs(lobe_reflectivity(known.exponent, known.degrees * pi / 180) - known.reflectivity),
                  6e-9, where);
  }
}

} // namespace

void check_model(const DeviceModel& device, const ModelCases& cases, bool quick, std::size_t pairs,
                 Report& report) {
  check_reflectivity(device, cases, quick, report);
  check_values(device, cases, pairs, report);
  check_below(device, cases, report);
  check_known(device, cases, report);
}

} // namespace phlux::verify
