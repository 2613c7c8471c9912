#include "random/random_lights.h"

#include <vector>

#include <fmt/format.h>

namespace phlux::test {

using scene::Rgb;
using scene::Vec3;

RandomLights::RandomLights(SceneDraft& draft)
    : draft_(draft), radiance_(draft.values.chance(0.9) ? draft.values.log_uniform(1e-2, 1e2)
                                                        : draft.values.log_uniform(1e-8, 1e8)),
      maps_(draft.further.chance(0.5)) {}

Rgb RandomLights::color() {
  const Rgb tint = triple(draft_.values, 0.2, 1);
  const double level = radiance_ * draft_.values.log_uniform(0.3, 3);
  return level * (draft_.values.chance(0.3) ? Rgb(tint.r) : tint);
}

void RandomLights::write() {
  RandomNumbers& structure = draft_.structure;
  if (structure.chance(0.03)) return;
  const int count = 1 + structure.below(3);
  for (int i = 0; i < count; ++i) {
    const std::string type =
        draft_.closed
            ? structure.pick<std::string>({"area", "area", "point", "spot"})
            : structure.pick<std::string>({"area", "area", "point", "spot", "directional", "constant"});
    if (type == "area")
      ++lamps_;
    else if (type != "constant" || !sky_)
      emitter(type);
  }
}

void RandomLights::emitter(const std::string& type) {
  SceneText& text = draft_.text;
  const bool map = type == "constant" && maps_;
  text.open("emitter", fmt::format("type=\"{}\"", map ? "envmap" : type));
  const Rgb light = color();
  if (type == "point") {
    text.color("intensity", draft_.scale * draft_.scale * light);
    text.point("position", draft_.in_world(lamp_place()));
  } else if (type == "spot") {
    spot(light);
  } else if (type == "directional") {
    text.color("irradiance", light);
    text.triple("vector name=\"direction\"", -above_floor(draft_.values, 1, 2));
  } else {
    if (map)
      environment_map(0.3 * light);
    else
      text.color("radiance", 0.3 * light);
    sky_ = true;
  }
  text.close("emitter");
}

void RandomLights::spot(const Rgb& light) {
  RandomNumbers& values = draft_.values;
  SceneText& text = draft_.text;
  const Vec3 from = lamp_place(), to = triple(values, -0.3, 0.3);
  text.color("intensity", 3 * draft_.scale * draft_.scale * light);
  const double cutoff = values.uniform(5, values.chance(0.2) ? 180 : 60);
  text.real("cutoff_angle", cutoff);
  if (values.chance(0.6)) text.real("beam_width", 0.999 * cutoff * values.uniform());
  draft_.open_to_world();
  text.line(look_at("lookat", draft_.in_world(from), draft_.in_world(to), up_for(to - from)));
  text.close("transform");
}

// With dark and with bright texels.
void RandomLights::environment_map(const Rgb& color) {
  RandomNumbers& values = draft_.values;
  const int width = 1 + values.below(7), height = 1 + values.below(5);
  std::vector<Rgb> texels;
  for (int i = 0; i < width * height; ++i) {
    const double level = values.pick({0.0, 0.3, 0.5, 0.8, 1.0, 10.0});
    texels.push_back(level * color * triple(values, 0.5, 1));
  }
  draft_.files["sky.hdr"] = rgbe_file(width, texels);
  draft_.text.string("filename", "sky.hdr");
  draft_.text.real("scale", values.uniform(0.5, 1));
  draft_.open_to_world();
  if (values.chance(0.3)) draft_.text.line("<scale x=\"-1\"/>");
  draft_.text.line(fmt::format("<rotate x=\"1\" y=\".5\" angle=\"{}\"/>", values.below(360)));
  draft_.text.close("transform");
}

Vec3 RandomLights::lamp_place() {
  return draft_.place([&](RandomNumbers& random) {
    return draft_.closed ? triple(random, -0.6, 0.6) : above_floor(random, 0.8, 2);
  });
}

} // namespace phlux::test
