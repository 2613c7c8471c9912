#include "random/methods.h"
#include "materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "random/random_numbers.h"
#include "random/random_scene.h"
#include "random/surfaces.h"
#include "render/device_scene.h"
#include "scene/lights.h"

namespace phlux::test {
namespace {

using render::Connect;
using render::Settings;
using render::Traversal;
using render::Weights;
using scene::Vec3;

constexpr double sharp = 100, sharp_for_eye = 50;
constexpr int longest_path = 9;                          // edges; longer paths carry little light
constexpr double narrow_view = 0.002;                    // few light paths end in it
constexpr double small_light = 1e-3, large_light = 0.02; // in the unit of SceneFacts
constexpr double small_spot = 0.02, little_power = 0.05;

struct Kind {
  const char* integrator;
  Connect connect = Connect::mis;
  Weights weights = Weights::balance;
};

std::string name_of_kind(const Settings& s) {
  if (s.integrator == "path")
    return s.connect == Connect::none ? "path none" : s.connect == Connect::light ? "path light" : "path mis";
  if (s.integrator == "light") return "light";
  return s.weights == Weights::balance ? "bidir balance"
         : s.weights == Weights::power ? "bidir power"
                                       : "bidir uniform";
}

// Chooses the method that covers the most pairs of features that are not covered yet.
class Covering {
public:
  explicit Covering(std::uint64_t seed) : random_(seed) {}

  Settings choose(const std::vector<Kind>& kinds, const std::vector<std::string>& strategies) {
    constexpr int candidates = 40;
    Settings best;
    std::size_t most = 0;
    for (int i = 0; i < candidates; ++i) {
      const Settings candidate = any(kinds, strategies);
      std::size_t fresh = 1;
      for (const std::string& pair : pairs_of(candidate)) fresh += covered_.contains(pair) ? 0 : 1;
      if (fresh <= most) continue;
      most = fresh;
      best = candidate;
    }
    for (const std::string& pair : pairs_of(best)) covered_.insert(pair);
    return best;
  }

private:
  Settings any(const std::vector<Kind>& kinds, const std::vector<std::string>& strategies) {
    Settings s;
    const Kind& kind = kinds[static_cast<std::size_t>(random_.below(static_cast<int>(kinds.size())))];
    s.integrator = kind.integrator;
    s.connect = kind.connect;
    s.weights = kind.weights;
    s.strategy = strategies[static_cast<std::size_t>(random_.below(static_cast<int>(strategies.size())))];
    s.lanes = random_.pick({1, 4, 8, 16});
    s.traversal = random_.pick({Traversal::brute_force, Traversal::bvh});
    return s;
  }

  static std::vector<std::string> pairs_of(const Settings& s) {
    const std::array<std::string, 4> features{name_of_kind(s), s.strategy, fmt::format("width {}", s.lanes),
                                              s.traversal == Traversal::bvh ? "bvh" : "brute"};
    std::vector<std::string> pairs;
    for (std::size_t i = 0; i < features.size(); ++i)
      for (std::size_t j = i + 1; j < features.size(); ++j) pairs.push_back(features[i] + ", " + features[j]);
    return pairs;
  }

  RandomNumbers random_;
  std::set<std::string> covered_;
};

std::vector<std::string> unbiased_strategies() {
  std::vector<std::string> names = render::strategy_names();
  std::erase(names, "lobe-estimate-printed");
  return names;
}

Vec3 vector_of(const float (&v)[3]) {
  return {v[0], v[1], v[2]};
}

// Light paths end anywhere on the surfaces, whose area is about that of a sphere with the scene's radius; a
// film of solid angle w sees the area w d^2 / cosine at the distance d. An orthographic film sees its own
// area.
double narrowest_view(const Surfaces& surfaces, const CameraRecord& camera, double radius) {
  double narrowest = 1;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const double across = 1 - 2 * ((x + 0.5) / camera.width + static_cast<double>(camera.principal_x));
      const double along = 1 - 2 * ((y + 0.5) / camera.height + static_cast<double>(camera.principal_y));
      const Vec3 way =
          vector_of(camera.forward) + across * vector_of(camera.left) + along * vector_of(camera.up);
      const double film = static_cast<double>(camera.film_area) / std::pow(glm::length(way), 3);
      const auto hit = surfaces.first_hit(vector_of(camera.position), glm::normalize(way));
      const double nearness =
          hit ? std::min(1.0, hit->distance * hit->distance / (radius * radius * hit->cosine)) : 1;
      narrowest = std::min(narrowest, film * nearness / (4 * std::numbers::pi));
    }
  return narrowest;
}

// Origin of the rays of a light in a direction, if it emits any there.
std::optional<Vec3> source(const Surfaces& surfaces, const LightRecord& light, const Vec3& way) {
  constexpr double off = 1e-6; // relative to the distance that counts as near
  switch (light.kind) {
  case LIGHT_POINT:
    return vector_of(light.position);
  case LIGHT_SPOT:
    if (glm::dot(way, vector_of(light.direction)) < std::cos(static_cast<double>(light.cutoff))) return {};
    return vector_of(light.position);
  case LIGHT_PLANAR: {
    const Surfaces::Place place = surfaces.middle(light.primitive);
    if (glm::dot(way, place.normal) <= 0) return {};
    return place.position + off * std::sqrt(static_cast<double>(light.area)) * place.normal;
  }
  case LIGHT_SPHERE:
    return surfaces.middle(light.primitive).position +
           (1 + off) * std::sqrt(static_cast<double>(light.area) / (4 * std::numbers::pi)) * way;
  default:
    return {};
  }
}

// The share of a light's power that falls on surfaces nearer than `near`, from rays in the directions of a
// Fibonacci lattice. A light larger than that makes no small spot.
double part_on_near_surfaces(const Surfaces& surfaces, const LightRecord& light, double near) {
  constexpr int directions = 1000;
  const bool planar = light.kind == LIGHT_PLANAR;
  if ((planar || light.kind == LIGHT_SPHERE) && static_cast<double>(light.area) > near * near) return 0;
  double all = 0, part = 0;
  for (int i = 0; i < directions; ++i) {
    const double z = 1 - (2 * i + 1.0) / directions, angle = 2 * std::numbers::pi * i * std::numbers::phi;
    const double across = std::sqrt(1 - z * z);
    const Vec3 way(across * std::cos(angle), across * std::sin(angle), z);
    const std::optional<Vec3> from = source(surfaces, light, way);
    if (!from) continue;
    const double power = planar ? glm::dot(way, surfaces.middle(light.primitive).normal) : 1;
    all += power;
    if (const auto hit = surfaces.first_hit(*from, way); hit && hit->distance < near) part += power;
  }
  return all > 0 ? part / all : 0;
}

// Whether lobes are too sharp to sample this many directions of a path without regard to them: for sampling
// by the cosine, each multiplies the relative second moment of f cos / density by (n + 2)^2 / (4 (n + 1)).
bool too_sharp(double exponent, int times, double most) {
  const auto moment = [](double n) { return (n + 2) * (n + 2) / (4 * (n + 1)); };
  return std::pow(moment(exponent), times) > 1.0001 * moment(most);
}

bool sampled_by_shape(const std::string& strategy) {
  return !std::set<std::string>{"uniform", "theta-phi", "cosine", "disk"}.contains(strategy);
}

} // namespace

SceneFacts facts_of(const scene::Scene& scene) {
  SceneFacts facts;
  facts.lights_without_area = has_unhittable_lights(scene);
  render::Settings settings;
  settings.double_precision = true;
  settings.traversal = Traversal::brute_force;
  const render::HostScene host = render::prepare(scene, settings, 1);
  for (const PrimitiveRecord& p : host.geometry->primitives) {
    if (p.region == REGION_NONE) continue;
    const scene::Material& m = scene.materials[static_cast<std::size_t>(p.material)];
    facts.delta |= m.model->has_delta;
    const bool anisotropic = m.model == lobes::shipped("anisotropicphong");
    if (anisotropic || (m.model == lobes::shipped("phong") && phlux::test::specular_of(m) != scene::Rgb(0.0)))
      facts.largest_exponent = std::max({facts.largest_exponent, phlux::test::exponent_of(m),
                                         anisotropic ? phlux::test::exponent_v_of(m) : 0.0});
  }
  const Surfaces surfaces(*host.geometry);
  facts.narrowest_view = scene.camera.orthographic
                             ? static_cast<double>(host.camera.film_area) /
                                   (4 * std::numbers::pi * std::pow(host.geometry->radius, 2))
                             : narrowest_view(surfaces, host.camera, host.geometry->radius);
  for (const LightRecord& light : host.lights.records) {
    const bool spreads = light.kind == LIGHT_POINT || light.kind == LIGHT_SPOT;
    const double unit = host.lights.unit / (spreads ? std::pow(host.geometry->radius, 2) : 1);
    for (const float power : light.radiance)
      facts.brightest = std::max(facts.brightest, unit * static_cast<double>(power));
    facts.in_small_spots += static_cast<double>(light.probability) *
                            part_on_near_surfaces(surfaces, light, small_spot * host.geometry->radius);
  }
  const double cross_section = std::numbers::pi * host.geometry->radius * host.geometry->radius;
  for (const accel::EmittingPrimitive& light : host.geometry->emitting)
    facts.smallest_light = std::min(facts.smallest_light, light.area / cross_section);
  return facts;
}

std::vector<Settings> methods_of_family(std::uint64_t family, int count) {
  static const std::vector<Kind> paths = {{"path", Connect::none}, {"path", Connect::light}, {"path"}};
  static const std::vector<Kind> bidirectional = {
      {"bidir"}, {"bidir", Connect::mis, Weights::power}, {"bidir", Connect::mis, Weights::uniform}};
  static const std::vector<Kind> weighted(bidirectional.begin(), bidirectional.begin() + 2);
  static const std::vector<std::string> all = unbiased_strategies();
  static const std::vector<std::string> shaped = {"exact",    "mixture", "fold",
                                                  "lobe-rho", "lobe-ks", "lobe-estimate"};
  Covering covering(1), fifth(2);
  std::vector<Settings> methods;
  for (std::uint64_t i = 0; i <= family; ++i) {
    const std::vector<std::string>& any = most_exponent(i) > sharp ? shaped : all;
    methods = {covering.choose({{"path"}}, shaped), covering.choose(paths, any),
               covering.choose({{"light"}}, any), covering.choose(bidirectional, any)};
    if (count > 4) methods.push_back(fifth.choose(weighted, shaped));
  }
  return methods;
}

Settings for_scene(Settings method, const scene::Scene& scene, const SceneFacts& facts) {
  if (method.connect == Connect::none && facts.lights_without_area) method.connect = Connect::mis;
  // Light tracing shows mirrors and glass black, and path tracing lacks light of points that they reflect.
  if (facts.delta &&
      (method.integrator == "light" || (method.integrator == "path" && facts.lights_without_area)))
    method.integrator = "bidir";
  method.max_depth = scene.defaults.max_depth;
  method.rr_depth = scene.defaults.rr_depth;
  return method;
}

std::string doubts(const Settings& method, const SceneFacts& facts) {
  const bool light = method.integrator == "light", path = method.integrator == "path";
  const int edges = method.max_depth < 0 ? longest_path : std::min(method.max_depth, longest_path);
  const bool lobes = too_sharp(facts.largest_exponent, 1, sharp);
  if (light && facts.narrowest_view < narrow_view) return "little in view";
  if (light && too_sharp(facts.largest_exponent, 1, sharp_for_eye)) return "eye connected to lobes";
  if (path && method.connect == Connect::light && lobes) return "lights connected to lobes";
  if (facts.lights_without_area && lobes) return "points connected to lobes";
  if (!sampled_by_shape(method.strategy) && too_sharp(facts.largest_exponent, edges - 1, sharp))
    return "lobes found by chance";
  if (facts.delta && facts.smallest_light < large_light) return "small light in mirrors";
  if (path && method.connect == Connect::none && facts.smallest_light < small_light) return "small light hit";
  if (path && facts.in_small_spots > little_power) return "small spot hit";
  return "";
}

bool has_infinite_variance(const Settings& method) {
  return method.integrator == "bidir" && method.weights == Weights::uniform;
}

std::string name_of(const Settings& method) {
  return fmt::format("{} {} {} {}", name_of_kind(method), method.strategy, method.lanes,
                     method.traversal == Traversal::bvh ? "bvh" : "brute");
}

} // namespace phlux::test
