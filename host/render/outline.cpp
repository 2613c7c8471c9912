#include "render/outline.h"

#include "errors.h"
#include "render/device_scene.h"

namespace phlux::render {

Outline outline(const scene::Scene& scene, const Settings& settings) try {
  Outline result;
  const device::Device device = device::open_devices(settings.devices, settings.threads).front();
  result.device = device.info;
  const int lanes = lanes_for(result.device, settings);
  const HostScene host = prepare(scene, settings, lanes);
  result.parts = find_parts(scene, *host.geometry, host.lights, settings, lanes);
  result.primitives = host.geometry->primitive_count;
  result.table_bytes = DeviceScene(device, host, result.parts).bytes();
  return result;
} catch (const cl::Error& error) {
  throw DeviceError(device::describe(error));
}

} // namespace phlux::render
