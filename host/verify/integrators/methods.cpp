#include "verify/integrators/methods.h"

#include <algorithm>

#include <fmt/format.h>

namespace phlux::verify {
namespace {

using settings::Connect;
using settings::Weights;

// Samples per pixel and render: enough for standard errors of about 0.04% of the radiance by path and bidir,
// and of 0.06% by light and with uniform weights, by the measured variances.
constexpr int of_path = 128, of_light = 512, of_bidir = 64, of_uniform = 256;

constexpr const char* hits = "hit_light (kernels/transport/eye_subpath.cl)";
constexpr const char* light_samples = "sampled_light (kernels/transport/eye_subpath.cl)";
constexpr const char* splats = "connect_to_camera (kernels/transport/light_subpath.cl)";

Method path_by(Connect connect, const char* look_at) {
  Method method;
  const std::string& name = settings::connect_names()[static_cast<std::size_t>(connect)];
  method.name = "path " + name;
  method.variant = "`connect` " + name;
  method.settings.connect = connect;
  method.look_at = look_at;
  method.samples = method.glossy_samples = of_path;
  method.quick = connect == settings::Settings().connect;
  return method;
}

Method light() {
  Method method;
  method.name = method.settings.integrator = "light";
  method.look_at = splats;
  method.samples = method.glossy_samples = of_light;
  method.quick = true;
  return method;
}

Method bidir_by(Weights weights) {
  Method method;
  const std::string& name = settings::weights_names()[static_cast<std::size_t>(weights)];
  method.name = "bidir " + name;
  method.variant = "`weights` " + name;
  method.settings.integrator = "bidir";
  method.settings.weights = weights;
  method.look_at = "heuristic (kernels/transport/mis_weights.cl)";
  method.samples = weights == Weights::uniform ? of_uniform : of_bidir;
  method.glossy_samples = of_bidir;
  method.quick = weights == settings::Settings().weights;
  return method;
}

Method techniques_apart() {
  Method method = bidir_by(Weights::balance);
  method.name = "bidir techniques";
  method.variant.clear();
  method.settings.techniques = true;
  method.settings.max_depth = technique_edges;
  method.glossy_samples = 0;
  return method;
}

} // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> list = {
      path_by(Connect::none, hits),
      path_by(Connect::light, light_samples),
      path_by(Connect::mis, "weight_of_sampled_light (kernels/transport/eye_subpath.cl)"),
      light(),
      bidir_by(Weights::balance),
      bidir_by(Weights::power),
      bidir_by(Weights::uniform),
      techniques_apart()};
  return list;
}

const Method* find_method(const std::string& name) {
  const auto found = std::ranges::find(methods(), name, &Method::name);
  return found == methods().end() ? nullptr : &*found;
}

std::string check_of(const film::Technique& technique) {
  return fmt::format("s{}-t{}", technique.light_vertices, technique.eye_vertices);
}

std::string check_of_length(int edges) {
  return fmt::format("{} edge{}", edges, edges == 1 ? "" : "s");
}

std::optional<film::Technique> technique_of(const std::string& check) {
  for (int edges = 1; edges <= technique_edges; ++edges)
    for (const film::Technique& technique : techniques_of(edges))
      if (check_of(technique) == check) return technique;
  return {};
}

bool is_length(const std::string& check) {
  for (int edges = 1; edges <= technique_edges; ++edges)
    if (check_of_length(edges) == check) return true;
  return false;
}

std::string function_of(const film::Technique& technique) {
  if (technique.light_vertices == 0) return hits;
  if (technique == film::Technique{1, 1})
    return "connect_light_to_camera (kernels/transport/light_subpath.cl)";
  if (technique.eye_vertices == 1) return splats;
  if (technique.light_vertices == 1) return light_samples;
  return "connect (kernels/transport/bidir.cl)";
}

std::vector<film::Technique> techniques_of(int edges) {
  std::vector<film::Technique> list;
  for (int light_vertices = 0; light_vertices <= edges; ++light_vertices)
    list.push_back({light_vertices, edges + 1 - light_vertices});
  return list;
}

} // namespace phlux::verify
