#include "scene_file/color.h"

#include <charconv>
#include <cmath>

#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

constexpr const char* forms = "one number, three numbers or #rrggbb";

scene::Rgb read_hexadecimal(const Element& property, std::string_view digits) {
  unsigned encoded = 0;
  const char* end = digits.data() + digits.size();
  const auto [stopped, error] = std::from_chars(digits.data(), end, encoded, 16);
  if (digits.size() != 6 || error != std::errc{} || stopped != end)
    fail(property.where, "'" + property["value"] + "' is not a colour", forms);
  return scene::Rgb(encoded >> 16, encoded >> 8 & 255, encoded & 255) / 255.0;
}

scene::Rgb read_numbers(const Element& property) {
  const std::string& text = property["value"];
  const auto values = parse_reals(text);
  if (!values || (values->size() != 1 && values->size() != 3))
    fail(property.where,
         "'" + text + "' is not a colour" +
             (text.find(':') == text.npos ? "" : " (spectral curves are not supported)"),
         forms);
  return values->size() == 1 ? scene::Rgb((*values)[0])
                             : scene::Rgb((*values)[0], (*values)[1], (*values)[2]);
}

} // namespace

double decode_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

scene::Rgb read_color(const Element& property) {
  if (!property.has("value")) fail(property.where, property.name() + " without a value", forms);
  const auto pieces = split(property["value"]);
  const bool hexadecimal = pieces.size() == 1 && pieces[0].starts_with('#');
  scene::Rgb color = hexadecimal ? read_hexadecimal(property, pieces[0].substr(1)) : read_numbers(property);
  if (property.tag == "srgb")
    for (int i = 0; i < 3; ++i) color[i] = decode_srgb(color[i]);
  return color;
}

} // namespace phlux::scene_file
