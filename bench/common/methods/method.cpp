#include "bench/common/methods/method.h"

#include <algorithm>

namespace phlux::bench {
namespace {

const std::string default_strategy = "exact";

auto index_of(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) - names.begin();
}

} // namespace

std::string Method::name() const {
  const std::string integrated = variant == "-" ? integrator : integrator + " " + variant;
  return strategy == default_strategy ? integrated : integrated + ", " + strategy;
}

std::vector<Method> all_methods(const std::vector<std::string>& strategies, bool quick) {
  std::vector<Method> methods;
  for (const std::string& strategy : strategies) {
    for (const std::string& connect : render::connect_names()) methods.push_back({"path", strategy, connect});
    methods.push_back({"light", strategy, "-"});
    for (const std::string& weights : render::weights_names())
      if (!quick || weights == render::weights_names().front())
        methods.push_back({"bidir", strategy, weights});
  }
  return methods;
}

render::Settings settings_of(const Method& method, const scene::RenderDefaults& defaults) {
  render::Settings settings;
  settings.integrator = method.integrator;
  settings.strategy = method.strategy;
  if (method.integrator == "path")
    settings.connect = static_cast<render::Connect>(index_of(render::connect_names(), method.variant));
  if (method.integrator == "bidir")
    settings.weights = static_cast<render::Weights>(index_of(render::weights_names(), method.variant));
  settings.max_depth = defaults.max_depth;
  settings.rr_depth = defaults.rr_depth;
  return settings;
}

} // namespace phlux::bench
