#include "scene_file/transform.h"

#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>

#include "scene_file/coordinate_system.h"
#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

using glm::dmat4;
using glm::dvec3;

/// Relative precision of matrices in scene files.
constexpr double written_precision = 1e-3;
/// Smallest |det| / product of the columns' lengths, which is 1 for orthogonal columns. Below it, rounding in
/// double precision leaves no correct digit of the inverse in single precision.
constexpr double least_determinant = 1e-9;

double number(const Element& element, const std::string& attribute, double missing) {
  if (!element.has(attribute)) return missing;
  const auto value = parse_real(element[attribute]);
  if (!value)
    fail(element.where,
         "<" + element.tag + ">: " + attribute + " '" + element[attribute] + "' is not a number",
         "a finite number within single precision");
  return *value;
}

dvec3 triple_attribute(const Element& element, const std::string& attribute) {
  const auto values = parse_reals(element[attribute]);
  if (!values || values->size() != 3)
    fail(element.where,
         "<" + element.tag + ">: " + attribute + " '" + element[attribute] + "' is not a point",
         "three numbers");
  return {(*values)[0], (*values)[1], (*values)[2]};
}

bool is_zero(const dvec3& v) {
  return v == dvec3(0.0);
}

dmat4 rotation(const Element& step) {
  const bool has_axis = step.has("x") || step.has("y") || step.has("z") || step.has("value");
  const dvec3 axis = has_axis ? read_triple(step, 0.0) : dvec3(0.0);
  if (is_zero(axis)) fail(step.where, "<rotate> without an axis", "such as <rotate y=\"1\" angle=\"90\"/>");
  if (!step.has("angle"))
    fail(step.where, "<rotate> without an angle", "in degrees, such as <rotate y=\"1\" angle=\"90\"/>");
  return glm::rotate(dmat4(1.0), glm::radians(number(step, "angle", 0.0)), glm::normalize(axis));
}

dmat4 scaling(const Element& step) {
  return glm::scale(dmat4(1.0), read_triple(step, 1.0));
}

/// +z is the direction from origin to target, +x is to the left. By default, +x and +y are as in Mitsuba.
dmat4 look_at(const Element& step, int major_version) {
  const dvec3 origin = triple_attribute(step, "origin");
  const dvec3 to_target = triple_attribute(step, "target") - origin;
  if (is_zero(to_target))
    fail(step.where, "<lookat>: origin and target are the same point", "two different points");
  const dvec3 forward = glm::normalize(to_target);
  dvec3 up = step.has("up") ? triple_attribute(step, "up") : dvec3(0.0);
  if (is_zero(up)) up = first_tangent(forward, major_version);
  const dvec3 left = glm::cross(glm::normalize(up), forward);
  if (glm::length(left) < least_determinant)
    fail(step.where, "<lookat>: up is along the line from origin to target", "another direction");
  const dvec3 left_unit = glm::normalize(left);
  return {{left_unit, 0.0}, {glm::cross(forward, left_unit), 0.0}, {forward, 0.0}, {origin, 1.0}};
}

/// Row by row; nine numbers are the linear part alone.
dmat4 matrix(const Element& step) {
  const auto values = parse_reals(step["value"]);
  if (!values || (values->size() != 16 && values->size() != 9))
    fail(step.where, "<matrix>: '" + step["value"] + "'",
         "16 finite numbers, row by row, or 9 for the linear part");
  const int columns = values->size() == 16 ? 4 : 3;
  dmat4 result(1.0);
  for (int row = 0; row < columns; ++row)
    for (int column = 0; column < columns; ++column)
      result[column][row] = (*values)[static_cast<std::size_t>(row * columns + column)];
  if (columns == 4 &&
      glm::dvec4(result[0][3], result[1][3], result[2][3], result[3][3]) != glm::dvec4(0, 0, 0, 1))
    fail(step.where, "<matrix> is projective", "its last row must be 0 0 0 1");
  return result;
}

dmat4 read_step(const Element& step, int major_version) {
  if (step.tag == "translate") return glm::translate(dmat4(1.0), read_triple(step, 0.0));
  if (step.tag == "rotate") return rotation(step);
  if (step.tag == "scale") return scaling(step);
  if (step.tag == "lookat") return look_at(step, major_version);
  if (step.tag == "matrix") return matrix(step);
  fail(step.where, "<" + step.tag + "> inside <transform>", "translate, rotate, scale, lookat or matrix");
}

void check_invertible(const Element& transform, const dmat4& matrix) {
  double lengths = 1.0;
  bool representable = true;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row)
      representable &= std::abs(matrix[column][row]) <= std::numeric_limits<float>::max(); // false for NaN
    if (column < 3) lengths *= glm::length(dvec3(matrix[column]));
  }
  if (!representable) fail(transform.where, "the transform overflows", "smaller numbers");
  if (!(std::abs(glm::determinant(glm::dmat3(matrix))) > least_determinant * lengths))
    fail(transform.where, "the transform is singular", "one that keeps three dimensions");
}

} // namespace

glm::dvec3 read_triple(const Element& element, double missing) {
  const bool separate = element.has("x") || element.has("y") || element.has("z");
  if (separate == element.has("value"))
    fail(element.where, "<" + element.tag + "> needs either x, y and z or value",
         "such as x=\"1\" y=\"2\" z=\"3\"");
  if (!separate) {
    const auto uniform = parse_real(element["value"]); // for all three, as in Mitsuba 3
    return uniform ? dvec3(*uniform) : triple_attribute(element, "value");
  }
  return {number(element, "x", missing), number(element, "y", missing), number(element, "z", missing)};
}

bool is_similarity(const glm::dmat4& matrix) {
  const glm::dmat3 linear(matrix);
  const double square = glm::dot(linear[0], linear[0]);
  const glm::dmat3 gram = glm::transpose(linear) * linear;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::abs(gram[i][j] - (i == j ? square : 0.0)) > written_precision * square) return false;
  return true;
}

bool is_rigid(const glm::dmat4& matrix) {
  return is_similarity(matrix) && std::abs(glm::length(glm::dvec3(matrix[0])) - 1.0) <= written_precision;
}

glm::dmat4 read_transform(const Element& transform, int major_version) {
  dmat4 result(1.0);
  for (const auto& step : transform.children) result = read_step(step, major_version) * result;
  check_invertible(transform, result);
  return result;
}

} // namespace phlux::scene_file
