#include "random/methods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "random/random_numbers.h"
#include "random/random_scene.h"
#include "render/device_scene.h"

namespace phlux::test {
namespace {

using render::Connect;
using render::Settings;
using render::Traversal;
using render::Weights;

// A direction that is chosen without the lobe finds it in one of (n + 2) / 2 samples or fewer.
constexpr double sharp = 100, sharp_for_eye = 50;
constexpr double narrow_view = 0.01; // light paths that end in it are few, and in its darkest part fewer
constexpr double small_light = 1e-3; // in SceneFacts' unit

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

// Chooses what covers most pairs of features that were not yet.
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
  std::erase(names, "lobe-estimate-printed"); // MATH.md 2.4
  return names;
}

} // namespace

SceneFacts facts_of(const scene::Scene& scene) {
  SceneFacts facts;
  facts.lights_without_area =
      !scene.point_lights.empty() || !scene.spot_lights.empty() || !scene.directional_lights.empty();
  const render::HostScene host = render::prepare(scene, Traversal::brute_force, 1);
  for (const PrimitiveRecord& p : host.geometry.primitives) {
    if (p.region == REGION_NONE) continue;
    const scene::Material& m = scene.materials[static_cast<std::size_t>(p.material)];
    const bool anisotropic = m.kind == scene::Material::Kind::anisotropic_phong;
    if (anisotropic || m.specular != scene::Rgb(0.0))
      facts.largest_exponent =
          std::max({facts.largest_exponent, m.exponent_u, anisotropic ? m.exponent_v : 0.0});
  }
  for (const LightRecord& light : host.lights.records) {
    const bool spreads = light.kind == LIGHT_POINT || light.kind == LIGHT_SPOT;
    const double unit = host.lights.unit / (spreads ? std::pow(host.geometry.radius, 2) : 1);
    for (const float power : light.power)
      facts.brightest = std::max(facts.brightest, unit * static_cast<double>(power));
  }
  facts.view = std::min(1.0, static_cast<double>(host.camera.film_area) / (4 * std::numbers::pi));
  const double cross_section = std::numbers::pi * host.geometry.radius * host.geometry.radius;
  for (const accel::EmittingPrimitive& light : host.geometry.emitting)
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

Settings possible(Settings method, const SceneFacts& facts) {
  if (method.connect == Connect::none && facts.lights_without_area) method.connect = Connect::mis;
  return method;
}

std::string doubts(const Settings& method, const SceneFacts& facts) {
  const bool lobes = facts.largest_exponent > sharp;
  if (method.integrator == "light" && facts.view < narrow_view) return "little in view";
  if (method.integrator == "light" && facts.largest_exponent > sharp_for_eye) return "eye connected to lobes";
  if (method.integrator == "path" && method.connect == Connect::light && lobes)
    return "lights connected to lobes";
  if (facts.lights_without_area && lobes) return "points connected to lobes";
  if (method.integrator == "path" && method.connect == Connect::none && facts.smallest_light < small_light)
    return "small light hit";
  if (method.integrator == "bidir" && method.weights == Weights::uniform)
    return "connections without weights";
  return "";
}

std::string name_of(const Settings& method) {
  return fmt::format("{} {} {} {}", name_of_kind(method), method.strategy, method.lanes,
                     method.traversal == Traversal::bvh ? "bvh" : "brute");
}

} // namespace phlux::test
