#include "random/random_lights.h"

#include <fmt/format.h>

namespace phlux::test {

using scene::Rgb;
using scene::Vec3;

RandomLights::RandomLights(SceneDraft& draft)
    : draft_(draft), radiance_(draft.values.chance(0.9) ? draft.values.log_uniform(1e-2, 1e2)
                                                        : draft.values.log_uniform(1e-8, 1e8)) {}

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
  text.open("emitter", fmt::format("type=\"{}\"", type));
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

Vec3 RandomLights::lamp_place() {
  return draft_.place([&](RandomNumbers& random) {
    return draft_.closed ? triple(random, -0.6, 0.6) : above_floor(random, 0.8, 2);
  });
}

} // namespace phlux::test
