#include "scene_file/color.h"

#include <charconv>
#include <cmath>
#include <sstream>

#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>

#include "input_file.h"
#include "scene_file/properties.h"
#include "scene_file/spectrum.h"
#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

using scene::Rgb;
using Spectrum = std::vector<SpectralValue>;

constexpr const char* forms = "one number, three numbers or #rrggbb";

Rgb read_hexadecimal(const Element& property, std::string_view digits) {
  unsigned encoded = 0;
  const char* end = digits.data() + digits.size();
  const auto [stopped, error] = std::from_chars(digits.data(), end, encoded, 16);
  if (digits.size() != 6 || error != std::errc{} || stopped != end)
    fail(property.where, "'" + property["value"] + "' is not a colour", forms);
  return Rgb(encoded >> 16, encoded >> 8 & 255, encoded & 255) / 255.0;
}

Rgb read_numbers(const Element& property) {
  const std::string& text = property["value"];
  const auto values = parse_reals(text);
  if (!values || (values->size() != 1 && values->size() != 3))
    fail(property.where, "'" + text + "' is not a colour", forms);
  return values->size() == 1 ? Rgb((*values)[0]) : Rgb((*values)[0], (*values)[1], (*values)[2]);
}

void append(Spectrum& spectrum, std::optional<double> wavelength, std::optional<double> value,
            const Location& where) {
  constexpr const char* right = "pairs of a wavelength in nm and a value, in the order of wavelengths";
  if (!wavelength || !value || *wavelength <= 0.0) fail(where, "a malformed spectrum", right);
  if (!spectrum.empty() && spectrum.back().wavelength >= *wavelength)
    fail(where, "the wavelengths of the spectrum do not increase", right);
  spectrum.push_back({*wavelength, *value});
}

/// "400:0.5, 500:0.7"
Spectrum read_pairs(const Element& property) {
  Spectrum spectrum;
  for (const auto pair : split(property["value"])) {
    const auto colon = pair.find(':');
    const bool has_colon = colon != std::string_view::npos;
    append(spectrum, parse_real(pair.substr(0, colon)),
           has_colon ? parse_real(pair.substr(colon + 1)) : std::nullopt, property.where);
  }
  return spectrum;
}

/// An .spd file: a wavelength and a value on each line; # begins a comment.
Spectrum read_file(const std::filesystem::path& path, const Location& named_at) {
  std::istringstream stream(bytes_of(path).value_or(""));
  Location where{std::make_shared<const std::string>(path.string()), 1};
  Spectrum spectrum;
  for (std::string line; std::getline(stream, line); ++where.line) {
    const auto numbers = split(std::string_view(line).substr(0, line.find('#')));
    if (numbers.size() == 2)
      append(spectrum, parse_real(numbers[0]), parse_real(numbers[1]), where);
    else if (!numbers.empty())
      fail(where, "a malformed line of a spectrum", "a wavelength in nm and a value");
  }
  if (spectrum.empty())
    fail(named_at, "spectrum '" + path.string() + "' cannot be read or is empty",
         "an existing .spd file, named relative to the scene's folder");
  return spectrum;
}

std::vector<double> reals(Properties& properties, const std::string& name) {
  const auto values = parse_reals(properties.string(name, ""));
  if (!values || values->empty()) properties.fail_at(name, "not a list of numbers", "numbers and commas");
  return *values;
}

/// <spectrum type="regular"> and "irregular" of Mitsuba 2 and 3.
Spectrum read_tabulated(Properties& properties, const std::string& type) {
  if (properties.has("filename"))
    return read_file(properties.document().find(properties.string("filename", "")),
                     properties.where("filename"));
  const std::vector<double> values = reals(properties, "values");
  std::vector<double> wavelengths;
  if (type == "irregular") {
    wavelengths = reals(properties, "wavelengths");
  } else {
    const double first = properties.real("wavelength_min",
                                         properties.real("lambda_min", 0.0)), // Mitsuba 2: lambda
        last = properties.real("wavelength_max", properties.real("lambda_max", 0.0));
    for (std::size_t i = 0; i < values.size(); ++i)
      wavelengths.push_back(std::lerp(first, last,
                                      static_cast<double>(i) /
                                          static_cast<double>(std::max<std::size_t>(values.size() - 1, 1))));
  }
  if (wavelengths.size() != values.size())
    properties.fail_at("values", "as many values as wavelengths are needed", "two lists of the same length");
  Spectrum spectrum;
  for (std::size_t i = 0; i < values.size(); ++i)
    append(spectrum, wavelengths[i], values[i], properties.element().where);
  return spectrum;
}

class ColorReader {
public:
  ColorReader(const Element& property, const Document& document, bool emission, double most)
      : property_(property), document_(document), emission_(emission), most_(most) {}

  [[nodiscard]] Rgb read() const {
    if (property_.tag == "blackbody") return black_body_color(kelvin(property_["temperature"])) * scale();
    if (property_.tag == "spectrum" && property_.has("type")) return of_plugin();
    if (property_.has("filename"))
      return of_spectrum(read_file(document_.find(property_["filename"]), property_.where));
    if (!property_.has("value")) fail(property_.where, property_.name() + " without a value", forms);
    const std::string& text = property_["value"];
    if (property_.tag == "spectrum" && text.find(':') != std::string::npos)
      return of_spectrum(read_pairs(property_));
    const auto pieces = split(text);
    const bool hexadecimal = pieces.size() == 1 && pieces[0].starts_with('#');
    Rgb color = hexadecimal ? read_hexadecimal(property_, pieces[0].substr(1)) : read_numbers(property_);
    if (property_.tag == "spectrum" && emission_ && document_.major_version > 0 && !hexadecimal &&
        pieces.size() == 1)
      return color_of_xyz(color); // of equal energy, which is not white in sRGB
    if (property_.tag == "srgb")
      for (int i = 0; i < 3; ++i) color[i] = decode_srgb(color[i]);
    return property_.tag == "xyz" ? in_gamut(color_of_xyz(color)) : color;
  }

private:
  /// The colour with channels that Mitsuba does not clamp to the nearest valid value clamped.
  [[nodiscard]] Rgb in_gamut(const Rgb& color) const {
    const Rgb clamped = glm::clamp(color, 0.0, most_);
    if (glm::compMax(glm::abs(clamped - color)) > 0.01 * glm::compMax(glm::abs(color)))
      document_.warnings->add(property_.where, "the colour of '" + property_["name"] +
                                                   "' is outside the gamut of sRGB: clamped");
    return clamped;
  }

  [[nodiscard]] Rgb of_spectrum(Spectrum spectrum) const {
    if (document_.major_version == 0) extend_to_zero(spectrum);
    document_.note_once(property_.where,
                        std::string("spectra become colours by a fit of the CIE 1931 functions, ") +
                            spectrum_error);
    const bool equal_energy = emission_ || document_.major_version == 0;
    return in_gamut(color_of(spectrum, equal_energy ? Illuminant::equal : Illuminant::d65));
  }

  /// "5000K" or "5000"
  [[nodiscard]] double kelvin(std::string text) const {
    if (text.ends_with('K') || text.ends_with('k')) text.pop_back();
    const auto value = parse_real(text);
    if (!value || *value <= 0.0)
      fail(property_.where, "'" + text + "' is not a temperature", "kelvins above 0");
    return *value;
  }

  [[nodiscard]] double scale() const {
    const auto value = property_.has("scale") ? parse_real(property_["scale"]) : 1.0;
    if (!value)
      fail(property_.where, "scale '" + property_["scale"] + "' is not a number", "a finite number");
    return *value;
  }

  [[nodiscard]] Rgb black_body_color(double temperature) const {
    return of_spectrum(black_body(temperature));
  }

  /// The spectra of Mitsuba 2 and 3: <spectrum type="d65">.
  [[nodiscard]] Rgb of_plugin() const {
    Properties properties(property_, document_);
    const std::string type = property_.type();
    Rgb color;
    if (type == "d65")
      color = properties.color("color", Rgb(1.0)) * properties.real("scale", 1.0);
    else if (type == "uniform" || type == "rawconstant")
      color = properties.color("value", Rgb(1.0));
    else if (type == "srgb" || type == "rgb")
      color = properties.color("color", Rgb(1.0));
    else if (type == "blackbody")
      color = black_body_color(properties.real("temperature", 5000.0)) * properties.real("scale", 1.0);
    else if (type == "regular" || type == "irregular")
      color = of_spectrum(read_tabulated(properties, type));
    else
      fail(property_.where, property_.name() + " is not supported",
           "supported are d65, uniform, rawconstant, srgb, blackbody, regular, irregular");
    properties.finish();
    return color;
  }

  const Element& property_;
  const Document& document_;
  bool emission_;
  double most_;
};

} // namespace

double decode_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

scene::Rgb read_color(const Element& property, const Document& document, bool emission, double most) {
  return ColorReader(property, document, emission, most).read();
}

} // namespace phlux::scene_file
