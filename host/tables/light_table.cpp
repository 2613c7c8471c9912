#include "tables/light_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "tables/alias_table.h"
#include "tables/light_tree.h"

namespace phlux::tables {
namespace {

using scene::Rgb;
using scene::Vec3;
constexpr double pi = std::numbers::pi;

double mean(const Rgb& rgb) {
  return (rgb.r + rgb.g + rgb.b) / 3;
}

void set(float (&to)[3], const Vec3& from) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
}

LightRecord record_of(LightKinds kind, const Rgb& power) {
  LightRecord record{};
  record.kind = kind;
  record.primitive = -1;
  set(record.radiance, power);
  return record;
}

// Collects lights (their emission_density still without the probability of selection), the power of each in
// watts (averaged over the channels), and their groups: one per emitter of the scene, such as a mesh.
class Collector {
public:
  static constexpr int own_group = -1;
  void add(const LightRecord& record, double power, int group = own_group) {
    table.records.push_back(record);
    table.records.back().node = -1;
    powers.push_back(power);
    groups.push_back(group != own_group ? group : --last_own_);
  }
  // Sets the bounds of the last added light; bounds.light is set here.
  void place(LightBounds bounds) {
    bounds.light = static_cast<int>(table.records.size()) - 1;
    if (powers.back() > 0) placed.push_back(bounds);
  }
  LightTable table;
  std::vector<double> powers;
  std::vector<int> groups;
  std::vector<LightBounds> placed; // of lights with power

private:
  int last_own_ = own_group;
};

// Half of the samples in proportion to power, half uniformly over the emitters (and by power within one), so
// that a sky or sun, whose power grows with the scene, leaves samples to lights near the camera. A light
// without power is never chosen.
std::vector<double> selection_probabilities(const Collector& lights) {
  double total = 0;
  std::map<int, double> power_of_group;
  for (std::size_t i = 0; i < lights.powers.size(); ++i) {
    total += lights.powers[i];
    if (lights.powers[i] > 0) power_of_group[lights.groups[i]] += lights.powers[i];
  }
  std::vector<double> list;
  for (std::size_t i = 0; i < lights.powers.size() && total > 0; ++i) {
    const double power = lights.powers[i];
    list.push_back(power <= 0 ? 0
                              : 0.5 * power / total + 0.5 * power / power_of_group[lights.groups[i]] /
                                                          static_cast<double>(power_of_group.size()));
  }
  return list;
}

void add_surfaces(Collector& to, const scene::Scene& scene, accel::Geometry& geometry) {
  std::size_t emitting = 0;
  for (std::size_t i = 0; i < geometry.primitives.size(); ++i) {
    if (geometry.emitters[i] < 0) continue;
    const Rgb radiance = scene.area_emitters[static_cast<std::size_t>(geometry.emitters[i])].radiance;
    const bool sphere = static_cast<int>(i) >= geometry.first_sphere;
    LightRecord record = record_of(sphere ? LIGHT_SPHERE : LIGHT_PLANAR, radiance);
    const accel::EmittingPrimitive& emitter = geometry.emitting[emitting++];
    record.primitive = static_cast<int>(i);
    record.area = static_cast<float>(emitter.area);
    record.emission_density = static_cast<float>(1 / (pi * emitter.area));
    geometry.primitives[i].light = static_cast<int>(to.table.records.size());
    to.add(record, pi * emitter.area * mean(radiance), geometry.emitters[i]);
    const double widest = sphere ? emitter.area / 4 : emitter.area; // cross-section
    to.place({0, emitter.low, emitter.high, sphere ? Vec3(0, 0, 1) : emitter.normal, sphere ? pi : 0.0,
              widest * mean(radiance)});
  }
}

void add_points(Collector& to, const scene::Scene& scene, const Vec3& origin) {
  for (const scene::PointLight& light : scene.point_lights) {
    LightRecord record = record_of(LIGHT_POINT, light.intensity);
    set(record.position, light.position - origin);
    record.emission_density = static_cast<float>(1 / (4 * pi));
    to.add(record, 4 * pi * mean(light.intensity));
    const Vec3 at = light.position - origin;
    to.place({0, at, at, Vec3(0, 0, 1), pi, mean(light.intensity)});
  }
  for (const scene::SpotLight& light : scene.spot_lights) {
    LightRecord record = record_of(LIGHT_SPOT, light.intensity);
    set(record.position, light.position - origin);
    set(record.direction, light.direction);
    // A beam as wide as the cone falls off within a small part of it, to avoid a division by 0.
    const double transition = std::max(light.cutoff_angle - light.beam_width, 1e-6 * light.cutoff_angle);
    record.cutoff = static_cast<float>(light.cutoff_angle);
    record.inv_transition = static_cast<float>(1 / transition);
    // 1 / (2 pi (1 - cos(cutoff))), without cancellation: the kernel samples the whole cone uniformly.
    const double half_sine = std::sin(light.cutoff_angle / 2);
    record.emission_density = static_cast<float>(1 / (4 * pi * half_sine * half_sine));
    const double half_beam_sine = std::sin(light.beam_width / 2);
    const double full = 2 * pi * (half_beam_sine * half_beam_sine + half_sine * half_sine);
    to.add(record, full * mean(light.intensity));
    const Vec3 at = light.position - origin;
    to.place({0, at, at, light.direction, light.cutoff_angle, mean(light.intensity)});
  }
}

void add_distant(Collector& to, const scene::Scene& scene, double radius) {
  const double disk = pi * radius * radius;
  for (const scene::DirectionalLight& light : scene.directional_lights) {
    LightRecord record = record_of(LIGHT_DIRECTIONAL, light.irradiance);
    set(record.direction, light.direction);
    record.area = static_cast<float>(disk);
    record.emission_density = static_cast<float>(1 / disk);
    to.add(record, disk * mean(light.irradiance));
  }
  if (scene.environment) {
    to.table.sky = static_cast<int>(to.table.records.size());
    to.table.environment = environment_table(*scene.environment);
    LightRecord record = record_of(LIGHT_SKY, to.table.environment.largest);
    record.area = static_cast<float>(disk);
    record.emission_density = static_cast<float>(1 / disk);
    to.add(record, disk * to.table.environment.integral);
  } else if (scene.constant_radiance) {
    to.table.sky = static_cast<int>(to.table.records.size());
    LightRecord record = record_of(LIGHT_SKY, *scene.constant_radiance);
    record.area = static_cast<float>(disk);
    record.emission_density = static_cast<float>(1 / (4 * pi * disk));
    to.add(record, 4 * pi * disk * mean(*scene.constant_radiance));
  }
}

// `probabilities`: for light paths; `sky_sample`: that of the sky for a light sample.
void set_selection(LightTable& table, const std::vector<double>& probabilities, double sky_sample) {
  std::vector<double> others = probabilities; // given that the sky is not chosen
  const double without_sky = table.sky < 0 ? 1 : 1 - std::exchange(others.back(), 0.0);
  for (double& p : others)
    if (p > 0) p /= without_sky;
  const AliasTable cells = alias_table(others);
  for (std::size_t i = 0; i < others.size(); ++i) {
    LightRecord& record = table.records[i];
    record.probability = static_cast<float>(probabilities[i]);
    record.emission_density *= record.probability;
    record.sample_probability = static_cast<float>(others[i] * (1 - sky_sample));
    record.alias_threshold = static_cast<float>(cells.keep[i]);
    record.alias = cells.alias[i];
  }
  if (table.sky >= 0) table.records.back().sample_probability = static_cast<float>(sky_sample);
}

// The probability of the sky for a light sample. At every vertex a scattered ray samples a constant sky about
// as well as a light sample would; light samples are left to the other lights, whose variance they reduce
// more.
double sky_sample_probability(const LightTable& table, double probability, bool found_by_hits) {
  if (table.sky < 0) return 0;
  const bool constant = table.environment.texels.empty(), other_lights = probability < 1;
  return constant && other_lights && found_by_hits ? 0 : probability;
}

// A power of two near the largest radiance of a light, or irradiance of a point light at distance `radius`; 1
// within 2^-32 to 2^32.
double unit_of(const std::vector<LightRecord>& records, double radius) {
  constexpr int ordinary_exponent = 32;
  double most = 0;
  for (const LightRecord& record : records) {
    const double power = std::max({record.radiance[0], record.radiance[1], record.radiance[2]});
    const bool spreads = record.kind == LIGHT_POINT || record.kind == LIGHT_SPOT;
    most = std::max(most, spreads ? power / (radius * radius) : power);
  }
  const int exponent = most > 0 && std::isfinite(most) ? std::ilogb(most) : 0;
  return std::abs(exponent) <= ordinary_exponent ? 1 : std::ldexp(1.0, exponent);
}

void use_unit(LightTable& table, double unit) {
  table.unit = unit;
  for (LightRecord& record : table.records)
    for (float& power : record.radiance) power = static_cast<float>(power / unit);
  table.environment.use_unit(unit);
}

} // namespace

bool LightTable::has(LightKinds kind) const {
  return std::any_of(records.begin(), records.end(), [&](const LightRecord& r) { return r.kind == kind; });
}

bool LightTable::shines() const {
  return std::any_of(records.begin(), records.end(), [](const LightRecord& r) { return r.probability > 0; });
}

bool LightTable::samples_sky() const {
  return sky >= 0 && records[static_cast<std::size_t>(sky)].sample_probability > 0;
}

LightTable light_table(const scene::Scene& scene, accel::Geometry& geometry,
                       const settings::Settings& settings) {
  Collector collector;
  add_surfaces(collector, scene, geometry);
  add_points(collector, scene, geometry.origin);
  add_distant(collector, scene, geometry.radius);
  LightTable& table = collector.table;
  const std::vector<double> probabilities = selection_probabilities(collector);
  if (!probabilities.empty()) {
    const bool found_by_hits = settings::connect_of(settings) == settings::Connect::mis;
    set_selection(table, probabilities, sky_sample_probability(table, probabilities.back(), found_by_hits));
  }
  if (settings::wants_light_tree(settings)) table.nodes = light_tree(collector.placed, table.records);
  for (const LightBounds& light : collector.placed)
    table.tree_probability += table.records[static_cast<std::size_t>(light.light)].sample_probability;
  use_unit(table, unit_of(table.records, geometry.radius));
  return std::move(table);
}

} // namespace phlux::tables
