#include "scene_file/integrator.h"

#include <map>
#include <string>
#include <vector>

#include "scene_file/properties.h"
#include "settings/integrators.h"
#include "settings/values.h"

namespace phlux::scene_file {

namespace {

/// Methods of Mitsuba 0.6, 2 and 3 for the radiance that path tracing finds, and the integrator used for
/// each. Those with `vol` in their names are path tracing where there are no media, which are errors
/// themselves.
const std::map<std::string, std::string>& substitutes() {
  static const std::map<std::string, std::string> names{{"direct", "path"},
                                                        {"volpath", "path"},
                                                        {"volpath_simple", "path"},
                                                        {"volpathmis", "path"},
                                                        {"photonmapper", "path"},
                                                        {"ppm", "path"},
                                                        {"sppm", "path"},
                                                        {"vpl", "path"},
                                                        {"prb", "path"},
                                                        {"prb_basic", "path"},
                                                        {"prbvolpath", "path"},
                                                        {"prb_projective", "path"},
                                                        {"direct_projective", "path"},
                                                        {"guided_path", "path"},
                                                        {"pssmlt", "bidir"},
                                                        {"mlt", "bidir"},
                                                        {"erpt", "bidir"}};
  return names;
}

/// Integrators that hand the image to another one, nested inside.
bool is_wrapper(const std::string& type) {
  return type == "adaptive" || type == "irrcache" || type == "moment" || type == "aov" ||
         type == "multichannel";
}

std::string integrator_for(const Element& integrator) {
  const std::string type = integrator.type();
  std::vector<std::string> names;
  for (const settings::IntegratorInfo& info : settings::integrators) {
    if (type == info.mitsuba_name) return info.name;
    names.emplace_back(info.mitsuba_name);
  }
  const auto substitute = substitutes().find(type);
  if (substitute == substitutes().end())
    fail(integrator.where, integrator.name() + " is not supported",
         "supported are " + settings::joined(names) +
             ", for which other integrators of Mitsuba's are replaced");
  note(integrator.where, integrator.name() + " is replaced by " + substitute->second);
  return substitute->second;
}

void read_depths(Properties& properties, scene::RenderDefaults& defaults) {
  for (const auto& [name, depth] :
       {std::pair{"max_depth", &defaults.max_depth}, std::pair{"rr_depth", &defaults.rr_depth}}) {
    *depth = properties.integer(name, *depth);
    if (*depth < 1 && *depth != -1)
      properties.fail_at(name, std::to_string(*depth) + " is out of range", "1 or more, or -1 for no bound");
  }
}

} // namespace

void read_integrator(const Element& integrator, const Document& document, scene::Scene& scene) {
  Properties properties(integrator, document);
  const std::string type = integrator.type();
  if (is_wrapper(type)) {
    if (const Element* nested = properties.object("integrator")) {
      note(integrator.where, integrator.name() + " is replaced by the integrator inside");
      return read_integrator(*nested, document, scene);
    }
  }
  scene.defaults.integrator = integrator_for(integrator);
  read_depths(properties, scene.defaults);
  if (type == "direct") scene.defaults.max_depth = 2; // emission and direct light
  scene.hide_emitters = properties.boolean("hide_emitters", false);
  scene.strict_normals = properties.boolean("strict_normals", false);
  properties.require("show_weighted", false);
  if (type == "path" || type == "ptracer" || type == "bdpt")
    properties.pass_over({"light_image", "sample_direct", "granularity", "brute_force", "samples_per_pass",
                          "timeout", "lens_perturbation"});
  else
    properties.pass_over_rest();
  properties.finish();
}

} // namespace phlux::scene_file
