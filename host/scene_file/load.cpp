#include "scene_file/load.h"

#include "scene_file/document.h"
#include "scene_file/emitters.h"
#include "scene_file/materials.h"
#include "scene_file/properties.h"
#include "scene_file/sensor.h"
#include "scene_file/shapes.h"

namespace phlux::scene_file {

namespace {

void warn_of_darkness(const Document& document, const scene::Scene& scene) {
  const Location file{document.scene.where.file, 0};
  if (scene.patches.empty() && scene.spheres.empty() && scene.meshes.empty())
    warn(file, "empty scene: it has no shapes");
  if (scene.area_emitters.empty() && scene.point_lights.empty() && scene.spot_lights.empty() &&
      scene.directional_lights.empty() && !scene.constant_radiance)
    warn(file, "no light: nothing in the scene emits, and the image will be black");
}

} // namespace

scene::Scene load(const std::filesystem::path& file, const std::map<std::string, std::string>& definitions,
                  const std::optional<std::array<int, 2>>& size, const lobes::Library& library) {
  Document document;
  read_document(file, definitions, document);
  Properties properties(document.scene, document);
  scene::Scene scene;

  const Element* sensor = properties.object("sensor");
  if (!sensor)
    fail(document.scene.where, "the scene has no camera",
         "<sensor type=\"perspective\">...</sensor> is needed");
  read_sensor(*sensor, document, size, scene);
  if (const Element* integrator = properties.object("integrator"))
    read_integrator(*integrator, document, scene.defaults);

  const bool scale = properties.boolean("ensure_energy_conservation", false);
  const MaterialRules rules{library, scale ? ExcessEnergy::scale : ExcessEnergy::error};
  for (const Element* bsdf : properties.objects("bsdf")) // to check also those that no shape refers to
    static_cast<void>(read_material(*bsdf, document, rules));
  for (const Element* emitter : properties.objects("emitter")) read_emitter(*emitter, document, scene);
  for (const Element* shape : properties.objects("shape")) read_shape(*shape, document, rules, scene);
  properties.finish();
  warn_of_darkness(document, scene);
  scene.files = document.files;
  return scene;
}

} // namespace phlux::scene_file
