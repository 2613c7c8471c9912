#include "bench/arithmetic/formulas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace phlux::bench {
namespace {

using Vec = glm::dvec3;
using Random = FormulaGroup::Random;
using Error = FormulaGroup::Error;

constexpr double pi = std::numbers::pi;

double as_float(double value) {
  return static_cast<double>(static_cast<float>(value));
}

double uniform(Random& random, double from = 0, double to = 1) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

double log_uniform(Random& random, double from, double to) {
  return std::exp(uniform(random, std::log(from), std::log(to)));
}

Vec unit_vector(Random& random) {
  const double z = uniform(random, -1, 1), phi = uniform(random, 0, 2 * pi), s = std::sqrt(1 - z * z);
  return {s * std::cos(phi), s * std::sin(phi), z};
}

Vec vec_at(const double* values) {
  return {values[0], values[1], values[2]};
}
Vec vec_at(const float* values) {
  return {static_cast<double>(values[0]), static_cast<double>(values[1]), static_cast<double>(values[2])};
}

void put(const Vec& v, double* to) {
  to[0] = v.x, to[1] = v.y, to[2] = v.z;
}

Vec rounded(const Vec& v) {
  return {as_float(v.x), as_float(v.y), as_float(v.z)};
}

Error against(double exact, float value) {
  return {std::abs(static_cast<double>(value) - exact), std::abs(exact)};
}

// ---- cos^n of the angle between a lobe's axis and a direction of that lobe

void draw_lobe(Random& random, double exponent, double* inputs) {
  const Vec axis = unit_vector(random);
  const Vec x = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.5 ? Vec(1, 0, 0) : Vec(0, 1, 0)));
  const double log_cosine = std::log(uniform(random)) / (exponent + 1), phi = uniform(random, 0, 2 * pi);
  const double cosine = std::exp(log_cosine), sine = std::sqrt(-std::expm1(2 * log_cosine));
  put(axis, inputs);
  put(cosine * axis + sine * (std::cos(phi) * x + std::sin(phi) * glm::cross(axis, x)), inputs + 3);
}

Error lobe_error(const double* inputs, double exponent, const float* outputs) {
  const Vec chord = glm::normalize(vec_at(inputs)) - glm::normalize(vec_at(inputs + 3));
  return against(std::exp(exponent * std::log1p(-glm::dot(chord, chord) / 2)), outputs[0]);
}

// ---- sin(alpha) for cos(alpha) = u^(1 / (n + 1))

// The values that random.h can draw.
void draw_uniform(Random& random, double, double* inputs) {
  inputs[0] = (std::floor(uniform(random) * 0x1p23) + 0.5) * 0x1p-23;
}

Error sine_error(const double* inputs, double exponent, const float* outputs) {
  return against(std::sqrt(-std::expm1(2 * std::log(inputs[0]) / (exponent + 1))), outputs[0]);
}

// ---- Frames

// A quarter of the directions are near the poles.
void draw_direction(Random& random, double, double* inputs) {
  Vec z = unit_vector(random);
  if (uniform(random) < 0.25) {
    const double tilt = log_uniform(random, 1e-6, 1e-2);
    z = glm::normalize(Vec(tilt * z.x, tilt * z.y, std::copysign(1.0, z.z)));
  }
  put(z, inputs);
}

Error frame_error(const double* inputs, double, const float* outputs) {
  const Vec x = vec_at(outputs), y = vec_at(outputs + 3), z = glm::normalize(vec_at(inputs));
  return {std::max({std::abs(glm::length(x) - 1), std::abs(glm::length(y) - 1), std::abs(glm::dot(x, y)),
                    std::abs(glm::dot(x, z)), std::abs(glm::dot(y, z))}),
          1};
}

// ---- Cosine and sine of 2 pi u

Error turns_error(const double* inputs, double, const float* outputs) {
  const double angle = 2 * pi * inputs[0];
  return {std::max(std::abs(static_cast<double>(outputs[0]) - std::cos(angle)),
                   std::abs(static_cast<double>(outputs[1]) - std::sin(angle))),
          1};
}

// ---- Functions of one number

FormulaGroup function_group(const std::string& name, std::vector<Formula> formulas, double from, double to,
                            double (*exact)(double)) {
  FormulaGroup group{name, name, 1, 1, {0}, std::move(formulas), {}, {}};
  const double sign = to < 0 || from < 0 ? -1 : 1;
  group.draw = [from, to, sign](Random& random, double, double* inputs) {
    inputs[0] = sign * log_uniform(random, std::abs(from), std::abs(to));
  };
  group.error = [exact](const double* inputs, double, const float* outputs) {
    return against(exact(inputs[0]), outputs[0]);
  };
  return group;
}

// ---- Offsets

// Hit point of a ray on a plane, computed in float32, with coordinates of size 0.01 to 10,000. Hidden values:
// the exact hit point.
void draw_hit(Random& random, double, double* inputs) {
  const double scale = log_uniform(random, 1e-2, 1e4);
  const Vec origin = rounded(scale * unit_vector(random)), direction = rounded(unit_vector(random));
  const double distance = as_float(scale * uniform(random, 0.1, 2));
  const Vec way = distance * direction, hit = origin + way;
  for (int axis = 0; axis < 3; ++axis) inputs[axis] = as_float(as_float(way[axis]) + origin[axis]);
  put(unit_vector(random), inputs + 3);
  inputs[6] = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
  put(hit, inputs + 7);
}

// Distance of the offset position from its plane, relative to the largest coordinate; failed if the position
// is not in front of the plane.
Error offset_error(const double* inputs, double, const float* outputs) {
  const Vec hit = vec_at(inputs + 7);
  const double height = glm::dot(vec_at(outputs) - hit, vec_at(inputs + 3));
  return {std::abs(height), std::max({std::abs(hit.x), std::abs(hit.y), std::abs(hit.z), inputs[6]}),
          height <= 0};
}

} // namespace

const std::vector<FormulaGroup>& formula_groups() {
  static const std::vector<double> exponents = {10, 100, 1e4, 1e6};
  static const std::vector<FormulaGroup> groups = [] {
    std::vector<FormulaGroup> list;
    list.push_back({"lobe",
                    "cos^n of the angle between two directions",
                    6,
                    1,
                    exponents,
                    {{"lobe_pow", "dot^n by pow"},
                     {"lobe_powr", "dot^n by powr"},
                     {"lobe_native_powr", "dot^n by native_powr", false, true},
                     {"lobe_native_exp_log", "dot^n by native_exp and native_log", false, true},
                     {"lobe_exp_log", "dot^n by exp and log"},
                     {"lobe_own_pow", "dot^n by own polynomials"},
                     {"lobe_exp_versine", "exp(-n |a-b|²/2)"},
                     {"lobe_exp_log1p", "exp(n log1p(-|a-b|²/2))", true},
                     {"lobe_own_log1p", "exp(n log1p(-|a-b|²/2)) by own log1p"}},
                    draw_lobe,
                    lobe_error});
    list.push_back({"sine",
                    "sin(alpha) of a lobe sample",
                    1,
                    1,
                    exponents,
                    {{"sine_pow", "sqrt(1 - u^(2/(n+1)))"},
                     {"sine_product", "sqrt((1 - c)(1 + c))"},
                     {"sine_native", "sqrt(1 - u^(2/(n+1))) by native functions", false, true},
                     {"sine_own_pow", "sqrt(1 - u^(2/(n+1))) by own polynomials"},
                     {"sine_own", "sqrt(-expm1(2 log(u)/(n+1))) by own functions"},
                     {"sine_log", "sqrt(-2 log(u)/(n+1))"},
                     {"sine_expm1", "sqrt(-expm1(2 log(u)/(n+1)))", true}},
                    draw_uniform,
                    sine_error});
    list.push_back({"frame",
                    "a frame about a direction",
                    3,
                    6,
                    {0},
                    {{"frame_duff", "Duff et al.", true},
                     {"frame_frisvad", "Frisvad"},
                     {"frame_cross", "cross product with the smaller axis"},
                     {"frame_up", "cross product with a fixed axis"}},
                    draw_direction,
                    frame_error});
    list.push_back({"turns",
                    "cosine and sine of 2 pi u",
                    1,
                    2,
                    {0},
                    {{"turns_own", "cos_sin_turns", true},
                     {"turns_sincos", "sincos"},
                     {"turns_cospi", "cospi and sinpi"},
                     {"turns_root", "cos and a root"},
                     {"turns_native", "native_cos and native_sin", false, true}},
                    draw_uniform,
                    turns_error});
    list.push_back({"offset",
                    "offset of a position from its surface",
                    7,
                    3,
                    {0},
                    {{"offset_scaled", "scaled by coordinates", true},
                     {"offset_ulps", "units in the last place"},
                     {"offset_fixed", "fixed: 1/1000"}},
                    draw_hit,
                    offset_error,
                    3});
    list.push_back(function_group("exp",
                                  {{"function_exp", "exp", true},
                                   {"function_native_exp", "native_exp", false, true},
                                   {"function_own_exp2", "own exp"}},
                                  -1e-6, -20, [](double x) { return std::exp(x); }));
    list.push_back(function_group("log",
                                  {{"function_log", "log", true},
                                   {"function_native_log", "native_log", false, true},
                                   {"function_own_log", "own log"}},
                                  1e-6, 1, [](double x) { return std::log(x); }));
    list.push_back(function_group("log1p",
                                  {{"function_log1p", "log1p", true}, {"function_own_log1p", "own log1p"}},
                                  -1e-8, -0.9, [](double x) { return std::log1p(x); }));
    list.push_back(function_group("expm1",
                                  {{"function_expm1", "expm1", true}, {"function_own_expm1", "own expm1"}},
                                  -1e-8, -10, [](double x) { return std::expm1(x); }));
    list.push_back(function_group(
        "sqrt", {{"function_sqrt", "sqrt", true}, {"function_native_sqrt", "native_sqrt", false, true}}, 1e-6,
        1, [](double x) { return std::sqrt(x); }));
    list.push_back(function_group("rsqrt",
                                  {{"function_one_over_sqrt", "1 / sqrt", true},
                                   {"function_rsqrt", "rsqrt"},
                                   {"function_native_rsqrt", "native_rsqrt", false, true}},
                                  1e-6, 1, [](double x) { return 1 / std::sqrt(x); }));
    list.push_back(function_group(
        "divide",
        {{"function_divide", "1 / x", true}, {"function_native_divide", "native_recip", false, true}}, 1e-6,
        1, [](double x) { return 1 / x; }));
    return list;
  }();
  return groups;
}

} // namespace phlux::bench
