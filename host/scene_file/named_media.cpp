#include "scene_file/named_media.h"

#include <algorithm>

#include "scene_file/values.h"

namespace phlux::scene_file {
namespace {

struct Dielectric {
  const char* name;
  double index;
};

// At 589 nm and room temperature, with Mitsuba's names and values (0.6 documentation, table 5).
constexpr Dielectric dielectrics[] = {
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.5750},      {"diamond", 2.419}};

struct Metal {
  const char* name;
  double eta[3], k[3];
};

// Measured spectra, as refractiveindex.info lists them, times CIE's daylight D65 and its colour matching
// functions of 1931 (as fitted by Wyman, Sloan and Shirley 2013), converted to linear sRGB so that a constant
// spectrum has equal channels. Ag, Au, Co, Cr, Cu, Fe, Ni, Pd, Ti, V: Johnson and Christy 1972, 1974. Al:
// Rakic 1995. Be, Pt, W: Rakic, Djurisic, Elazar and Majewski 1998 (Lorentz-Drude). Hg: Inagaki, Arakawa and
// Williams 1981. Ir: Schmitt et al. 2022. K: Smith 1969. Li: Rasigni and Rasigni 1977. Mo: Kirillova et al.
// 1971. Na: Inagaki et al. 1976. Nb: Weaver, Lynch and Olson 1973. Rh: Weaver, Olson and Lynch 1977. TiC,
// TiN, VC, VN: Pfluger et al. 1984.
constexpr Metal metals[] = {{"Ag", {0.0555, 0.0546, 0.0429}, {4.35, 3.54, 2.56}},
                            {"Al", {1.47, 0.987, 0.597}, {7.63, 6.56, 5.34}},
                            {"Au", {0.0646, 0.496, 1.46}, {3.60, 2.33, 1.82}},
                            {"Be", {3.45, 3.34, 3.06}, {3.18, 3.15, 3.14}},
                            {"Co", {2.25, 2.03, 1.71}, {4.21, 3.80, 3.23}},
                            {"Cr", {3.25, 3.11, 2.28}, {3.29, 3.34, 3.12}},
                            {"Cu", {0.181, 1.04, 1.29}, {3.27, 2.61, 2.36}},
                            {"Fe", {2.92, 2.92, 2.54}, {3.07, 2.94, 2.75}},
                            {"Hg", {2.02, 1.52, 1.01}, {5.29, 4.61, 3.79}},
                            {"Ir", {3.06, 2.60, 2.14}, {5.61, 5.08, 4.32}},
                            {"K", {0.0538, 0.0489, 0.0418}, {1.76, 1.43, 1.02}},
                            {"Li", {0.221, 0.206, 0.242}, {2.97, 2.44, 1.85}},
                            {"Mo", {3.47, 3.36, 2.79}, {3.53, 3.65, 3.53}},
                            {"Na", {0.0409, 0.0530, 0.0783}, {2.73, 2.25, 1.70}},
                            {"Nb", {2.91, 2.91, 2.62}, {2.83, 2.89, 2.81}},
                            {"Ni", {2.02, 1.90, 1.72}, {4.16, 3.57, 2.88}},
                            {"Pd", {1.78, 1.62, 1.39}, {4.34, 3.81, 3.20}},
                            {"Pt", {2.33, 2.08, 1.83}, {4.21, 3.67, 3.09}},
                            {"Rh", {2.16, 1.96, 1.72}, {5.67, 4.96, 4.39}},
                            {"Ti", {2.73, 2.51, 2.24}, {3.82, 3.40, 3.01}},
                            {"TiC", {3.07, 2.99, 2.85}, {2.73, 2.48, 2.39}},
                            {"TiN", {1.38, 1.22, 1.50}, {2.84, 2.05, 1.23}},
                            {"V", {3.48, 3.96, 3.62}, {2.97, 3.08, 3.47}},
                            {"VC", {3.04, 2.90, 2.79}, {2.56, 2.32, 2.16}},
                            {"VN", {2.39, 2.24, 2.14}, {2.54, 2.17, 1.79}},
                            {"W", {3.69, 3.44, 3.35}, {2.94, 2.74, 2.51}}};

scene::Rgb rgb(const double (&channels)[3]) {
  return {channels[0], channels[1], channels[2]};
}

template<typename List>
std::string names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& each : list) names.emplace_back(each.name);
  return join(names);
}

} // namespace

std::optional<double> index_of_dielectric(const std::string& name) {
  const auto* const found = std::ranges::find(dielectrics, name, &Dielectric::name);
  return found == std::end(dielectrics) ? std::nullopt : std::optional(found->index);
}
std::string names_of_dielectrics() {
  return names_of(dielectrics);
}

std::optional<ComplexIndex> index_of_metal(const std::string& name) {
  const std::string element = name.substr(0, name.find("_palik"));
  const auto* const found = std::ranges::find(metals, element, &Metal::name);
  return found == std::end(metals) ? std::nullopt
                                   : std::optional(ComplexIndex{rgb(found->eta), rgb(found->k)});
}
std::string names_of_metals() {
  return names_of(metals);
}

} // namespace phlux::scene_file
