#include "random/random_materials.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace phlux::test {

using scene::Rgb;

namespace {

constexpr double tiny_exponent = 0.1; // lower limit of exponents drawn uniformly in their logarithm

// 24 bits a pixel, blue first, from the top; rounded down.
std::string tga_file(int width, const std::vector<Rgb>& pixels) {
  std::string bytes(18, '\0');
  bytes[2] = 2; // no compression
  bytes[12] = static_cast<char>(width);
  bytes[14] = static_cast<char>(static_cast<int>(pixels.size()) / width);
  bytes[16] = 24;
  bytes[17] = 0x20;
  for (const Rgb& pixel : pixels)
    for (const double value : {pixel.b, pixel.g, pixel.r}) bytes += static_cast<char>(255 * value);
  return bytes;
}

} // namespace

RandomMaterials::RandomMaterials(SceneDraft& draft, double most_exponent)
    : draft_(draft), most_exponent_(most_exponent) {}

void RandomMaterials::write() {
  count_ = 2 + draft_.structure.below(3);
  for (int i = 0; i < count_; ++i) write_one(i);
}

void RandomMaterials::write_one(int index) {
  RandomNumbers &structure = draft_.structure, &further = draft_.further;
  const bool polished = structure.chance(0.12); // or rough: with a surface that Fresnel's equations describe
  const std::string type =
      polished ? structure.pick({"conductor", "dielectric", "thindielectric", "plastic", "roughconductor",
                                 "roughdielectric", "roughplastic"})
               : structure.pick({"diffuse", "diffuse", "phong", "phong", "phong", "anisotropicphong"});
  const bool two_sided = structure.chance(0.4) && !type.ends_with("dielectric");
  masked_.push_back(index > 0 && further.chance(0.25));
  const bool mask_outside = further.chance(0.5);
  std::vector<std::string> wrappers;
  if (two_sided) wrappers.emplace_back("twosided");
  if (masked_.back()) wrappers.insert(mask_outside ? wrappers.begin() : wrappers.end(), "mask");
  std::string id = fmt::format(" id=\"material{}\"", index);
  for (const std::string& wrapper : wrappers) {
    draft_.text.open("bsdf", fmt::format("type=\"{}\"{}", wrapper, std::exchange(id, "")));
    if (wrapper == "mask") opacity();
  }
  if (polished)
    fresnel(type, id);
  else
    lobes(type, id);
  for (std::size_t i = 0; i < wrappers.size(); ++i) draft_.text.close("bsdf");
}

void RandomMaterials::refer_to_one(bool lamp) {
  const int index = draft_.structure.below(count_);
  const bool masked = masked_[static_cast<std::size_t>(index)];
  draft_.text.line(fmt::format("<ref id=\"material{}\"/>", lamp && masked ? 0 : index));
}

void RandomMaterials::opacity() {
  const std::string kind = draft_.further.pick<std::string>({"number", "colour", "texture"});
  if (kind == "number") draft_.text.real("opacity", draft_.values.uniform());
  if (kind == "colour") draft_.text.color("opacity", triple(draft_.values, 0, 1));
  if (kind == "texture") texture("opacity", Rgb(1));
}

// A constant or a texture.
void RandomMaterials::color(const char* name, const Rgb& value) {
  if (draft_.further.chance(0.15) && std::max({value.r, value.g, value.b}) <= 1)
    texture(name, value);
  else
    draft_.text.color(name, value);
}

void RandomMaterials::texture(const char* name, const Rgb& largest) {
  RandomNumbers& values = draft_.values;
  SceneText& text = draft_.text;
  const auto some = [&] { return values.uniform() * largest; };
  const std::string kind = draft_.further.pick<std::string>({"checkerboard", "hdr", "tga"});
  text.open("texture", fmt::format("type=\"{}\" name=\"{}\"", kind == "checkerboard" ? kind : "bitmap",
                                   text.spelling(name)));
  if (kind == "checkerboard") {
    text.color("color0", some());
    text.color("color1", largest);
  } else {
    const int width = 1 + values.below(5), height = 1 + values.below(4);
    std::vector<Rgb> texels;
    for (int i = 0; i < width * height; ++i) texels.push_back(values.chance(0.3) ? largest : some());
    const std::string file = fmt::format("image{}.{}", images_++, kind);
    draft_.files[file] = kind == "hdr" ? rgbe_file(width, texels) : tga_file(width, texels);
    text.string("filename", file);
    text.boolean("raw", true);
    text.string("filter_type", values.pick({"nearest", "bilinear"}));
    text.string("wrap_mode", values.pick({"repeat", "mirror", "clamp"}));
  }
  text.real("uscale", values.uniform(-4, 4));
  text.real("voffset", values.uniform());
  text.close("texture");
}

void RandomMaterials::lobes(const std::string& type, const std::string& id) {
  RandomNumbers &structure = draft_.structure, &values = draft_.values;
  SceneText& text = draft_.text;
  text.open("bsdf", fmt::format("type=\"{}\"{}", type, id));
  const bool black = structure.chance(0.08), no_diffuse = structure.chance(0.15);
  const bool grey = values.chance(0.3);
  Rgb diffuse, specular;
  for (int c = 0; c < 3; ++c) {
    const double total = black ? 0 : values.uniform(0.1, 0.99);
    const double share = no_diffuse ? 1 : values.uniform();
    diffuse[c] = grey && c > 0 ? diffuse[0] : total * (1 - share);
    specular[c] = grey && c > 0 ? specular[0] : total * share;
  }
  if (type == "diffuse") {
    color("reflectance", diffuse + specular);
  } else {
    if (values.chance(0.1) && !black) { // as Mitsuba scales it
      text.boolean("ensure_energy_conservation", true);
      diffuse *= 1.5;
      specular *= 1.5;
    }
    color("diffuse_reflectance", diffuse);
    color("specular_reflectance", specular);
    if (type == "phong") {
      text.real("exponent", exponent());
    } else {
      text.real("exponent_u", exponent());
      text.real("exponent_v", exponent());
    }
  }
  text.close("bsdf");
}

void RandomMaterials::fresnel(const std::string& type, const std::string& id) {
  RandomNumbers& values = draft_.values;
  SceneText& text = draft_.text;
  const auto drawn = [&](double lowest, double highest) { return triple(values, lowest, highest); };
  text.open("bsdf", fmt::format("type=\"{}\"{}", type, id));
  const bool metal = type.ends_with("conductor"), rough = type.starts_with("rough");
  if (metal && values.chance(0.5)) {
    text.string("material", values.pick({"Au", "Cu", "Al", "none"}));
  } else if (metal) {
    text.color("eta", drawn(0.1, 3));
    text.color("k", drawn(0, 4));
  } else if (values.chance(0.5)) {
    text.string("int_ior", "water");
  } else {
    text.real("int_ior", values.uniform(1.2, 2.4));
  }
  if (values.chance(0.5)) color("specular_reflectance", drawn(0.5, 1));
  if (type.ends_with("dielectric")) color("specular_transmittance", drawn(0.5, 1));
  if (type.ends_with("plastic")) {
    color("diffuse_reflectance", drawn(0, 1));
    text.boolean("nonlinear", values.chance(0.5));
  }
  if (rough) {
    const bool brushed = type != "roughplastic" && draft_.further.chance(0.5);
    text.real(brushed ? "alpha_u" : "alpha", values.uniform(0.2, 1));
    if (brushed) text.real("alpha_v", values.uniform(0.2, 1));
    text.string("distribution",
                brushed ? values.pick({"beckmann", "ggx"}) : values.pick({"beckmann", "ggx", "phong"}));
  }
  text.close("bsdf");
}

double RandomMaterials::exponent() {
  const auto drawn = [&] {
    if (draft_.values.chance(0.1)) return 0.0;
    if (draft_.values.chance(0.1)) return most_exponent_;
    return draft_.values.log_uniform(tiny_exponent, most_exponent_);
  }();
  return draft_.twin ? std::min(drawn, draft_.twin->most_exponent) : drawn;
}

} // namespace phlux::test
