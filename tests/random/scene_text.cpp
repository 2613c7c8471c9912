#include "random/scene_text.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace phlux::test {

SceneText::SceneText(std::string version, RandomNumbers& random)
    : version_(std::move(version)), random_(random) {}

void SceneText::line(const std::string& element) {
  body_ += std::string(static_cast<std::size_t>(2 * depth_), ' ') + element + '\n';
}

void SceneText::open(const std::string& tag, const std::string& attributes) {
  line(fmt::format("<{}{}{}>", tag, attributes.empty() ? "" : " ", attributes));
  ++depth_;
}

void SceneText::close(const std::string& tag) {
  --depth_;
  line(fmt::format("</{}>", tag));
}

std::string SceneText::spelling(std::string_view snake_case) const {
  if (!version_.starts_with('0')) return std::string(snake_case);
  std::string camel;
  for (std::size_t i = 0; i < snake_case.size(); ++i)
    if (snake_case[i] == '_')
      camel += static_cast<char>(std::toupper(static_cast<unsigned char>(snake_case[++i])));
    else
      camel += snake_case[i];
  return camel;
}

std::string SceneText::number(double value) {
  return fmt::format("{:.7g}", value);
}

std::string SceneText::numbers(const scene::Vec3& value, const char* between) {
  return number(value.x) + between + number(value.y) + between + number(value.z);
}

std::string SceneText::written(const std::string& number) {
  if (!random_.chance(0.1)) return number;
  const std::string name = fmt::format("value{}", parameters_++);
  defaults_ += fmt::format("  <default name=\"{}\" value=\"{}\"/>\n", name, number);
  return "$" + name;
}

void SceneText::real(std::string_view name, double value) {
  line(fmt::format("<float name=\"{}\" value=\"{}\"/>", spelling(name), written(number(value))));
}

void SceneText::integer(std::string_view name, int value) {
  line(fmt::format("<integer name=\"{}\" value=\"{}\"/>", spelling(name), written(std::to_string(value))));
}

void SceneText::boolean(std::string_view name, bool value) {
  line(fmt::format("<boolean name=\"{}\" value=\"{}\"/>", spelling(name), value));
}

void SceneText::string(std::string_view name, const std::string& value) {
  line(fmt::format("<string name=\"{}\" value=\"{}\"/>", spelling(name), value));
}

void SceneText::color(std::string_view name, const scene::Rgb& value) {
  const bool grey = value.r == value.g && value.g == value.b;
  const char* between = random_.chance(0.5) ? " " : ", ";
  const std::string text = grey && random_.chance(0.5) ? number(value.r) : numbers(value, between);
  const char* tag = random_.chance(0.2) ? "spectrum" : "rgb";
  line(fmt::format("<{} name=\"{}\" value=\"{}\"/>", tag, spelling(name), written(text)));
}

void SceneText::point(std::string_view name, const scene::Vec3& value) {
  triple(fmt::format("point name=\"{}\"", spelling(name)), value);
}

void SceneText::triple(const std::string& tag_and_name, const scene::Vec3& value) {
  if (random_.chance(0.5))
    line(fmt::format("<{} value=\"{}\"/>", tag_and_name, written(numbers(value))));
  else
    line(fmt::format("<{} x=\"{}\" y=\"{}\" z=\"{}\"/>", tag_and_name, written(number(value.x)),
                     number(value.y), number(value.z)));
}

std::string SceneText::text() const {
  return fmt::format("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<scene version=\"{}\">\n{}{}</scene>\n",
                     version_, defaults_, body_);
}

} // namespace phlux::test
