#include "render/first_hits.h"

#include <algorithm>

#include <fmt/format.h>

#include "device/work_groups.h"
#include "errors.h"
#include "render/device_scene.h"
#include "scene/scene_data.h"

namespace phlux::render {
namespace {

// Pixels of a launch, so that it is short on slow devices.
constexpr std::size_t pixels_per_launch = 1U << 16;

// Without what only the transport of light needs.
Settings without_transport(const Settings& settings) {
  Settings path = settings;
  path.integrator = "path";
  path.connect = Connect::light; // `none` is refused if rays can hit no light
  path.light_selection = settings::LightSelection::power;
  path.sampler = Sampler::independent;
  path.roulette = Roulette::strategy;
  path.techniques = false;
  path.ambient.reset();
  path.clamp.reset();
  return path;
}

} // namespace

std::vector<film::FirstHit> first_hits(const scene::Scene& scene, const Settings& settings,
                                       const film::Progress& progress) try {
  static_assert(sizeof(film::FirstHit) == FEATURE_WORDS * sizeof(float));
  const device::Device device = device::open_devices(settings.devices, settings.threads).front();
  const int lanes = lanes_for(device.info, settings);
  const Settings path = without_transport(settings);
  const HostScene host = prepare(scene, path, lanes);
  const Parts parts = find_parts(scene, *host.geometry, host.lights, path, lanes);
  const DeviceScene tables(device, host, parts);
  device::Kernel kernel(device::build(device, sources::KernelFiles(settings.kernel_dir),
                                      parts.source("transport/first_hit.cl")),
                        "trace_first_hits");
  tables.bind(kernel);
  std::vector<film::FirstHit> hits(static_cast<std::size_t>(scene.camera.width) *
                                   static_cast<std::size_t>(scene.camera.height));
  const cl::Buffer buffer(device.context, CL_MEM_WRITE_ONLY,
                          std::min(pixels_per_launch, hits.size()) * sizeof(film::FirstHit));
  kernel.set("first_sample", static_cast<cl_int>(settings.first_sample));
  kernel.set("samples", cl_int{first_hit_samples});
  kernel.set("seed",
             cl_uint2{{static_cast<cl_uint>(settings.seed), static_cast<cl_uint>(settings.seed >> 32)}});
  kernel.set("features", buffer);
  for (std::size_t first = 0; first < hits.size(); first += pixels_per_launch) {
    if (progress) progress(static_cast<double>(first) / static_cast<double>(hits.size()));
    const std::size_t pixels = std::min(pixels_per_launch, hits.size() - first);
    kernel.set("first_pixel", static_cast<cl_int>(first));
    kernel.set("pixel_count", static_cast<cl_int>(pixels));
    device.queue.enqueueNDRangeKernel(kernel.ready(), cl::NullRange,
                                      cl::NDRange(device::items_for(pixels, lanes)),
                                      cl::NDRange(device::group_size(lanes)));
    device.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, pixels * sizeof(film::FirstHit), &hits[first]);
  }
  return hits;
} catch (const cl::Error& error) {
  throw DeviceError(device::describe(error));
}

} // namespace phlux::render
