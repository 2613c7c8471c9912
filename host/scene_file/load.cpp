#include "scene_file/load.h"

#include "scene_file/document.h"
#include "scene_file/emitters.h"
#include "scene_file/integrator.h"
#include "scene_file/materials.h"
#include "scene_file/mesh_files.h"
#include "scene_file/properties.h"
#include "scene_file/sensor.h"
#include "scene_file/shapes.h"

namespace phlux::scene_file {

namespace {

void warn_of_darkness(const Document& document, const scene::Scene& scene) {
  const Location file{document.scene.where.file, 0};
  if (scene.patches.empty() && scene.spheres.empty() && scene.meshes.empty())
    document.warnings->add(file, "empty scene: it has no shapes");
  if (!scene::has_lights(scene))
    document.warnings->add(file, "no light: nothing in the scene emits, and the image will be black");
}

const Element& sensor_of(Properties& scene) {
  if (const Element* sensor = scene.object("sensor")) return *sensor;
  fail(scene.element().where, "the scene has no camera",
       "<sensor type=\"perspective\">...</sensor> is needed");
}

/// Whether the object has an id that no <ref> names; says so.
bool is_unused(const Element& object, const Document& document) {
  const bool unused = object.has("id") && !document.referred_to.contains(&object);
  if (unused) note(object.where, object.name() + " is used nowhere and is passed over");
  return unused;
}

} // namespace

scene::Scene load(const std::filesystem::path& file, const std::map<std::string, std::string>& definitions,
                  const std::optional<std::array<int, 2>>& size, const lobes::Library& library) {
  Document document;
  read_document(file, definitions, document);
  Properties properties(document.scene, document);
  scene::Scene scene;

  Problems& problems = *document.problems;
  problems.attempt([&] { read_sensor(sensor_of(properties), document, size, scene); });
  problems.attempt([&] {
    if (const Element* integrator = properties.object("integrator"))
      read_integrator(*integrator, document, scene);
  });
  const bool scale = properties.boolean("ensure_energy_conservation", false);
  TextureReader textures;
  const MaterialRules rules{library, textures, scale ? ExcessEnergy::scale : ExcessEnergy::error};
  for (const Element* texture : properties.objects("texture"))
    if (!is_unused(*texture, document))
      problems.attempt([&] { static_cast<void>(textures.read(*texture, document)); });
  for (const Element* bsdf : properties.objects("bsdf")) // to check also those that no shape refers to
    if (!is_unused(*bsdf, document))
      problems.attempt([&] { static_cast<void>(read_material(*bsdf, document, rules)); });
  for (const Element* emitter : properties.objects("emitter"))
    if (emitter->type() != "area" || !document.referred_to.contains(emitter))
      problems.attempt([&] { read_emitter(*emitter, document, scene); });
  MeshFiles meshes;
  std::map<const Element*, int> materials;
  SharedMaterials shared(scene.materials);
  for (const Element* shape : properties.objects("shape"))
    problems.attempt([&] { read_shape(*shape, document, {rules, scene, meshes, materials, shared}); });
  properties.finish();
  problems.throw_if_any();
  scene.files = document.files;
  meshes.load(scene, problems); // which adds their own files
  problems.throw_if_any();
  warn_of_darkness(document, scene);
  document.warnings->log();
  return scene;
}

} // namespace phlux::scene_file
