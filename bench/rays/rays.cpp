#include "bench/rays/rays.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <thread>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bench/common/report/draw.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/provenance.h"
#include "bench/rays/embree_rays.h"
#include "bench/rays/knot_scene.h"
#include "clock.h"
#include "device/kernel.h"
#include "errors.h"
#include "measure/moments.h"
#include "render/device_scene.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

using scene::Vec3;

double seconds_of(const std::function<void()>& work) {
  const Clock::time_point begin = Clock::now();
  work();
  return seconds_since(begin);
}

// ---- The device

class DeviceRays {
public:
  DeviceRays(const device::Device& device, const sources::KernelFiles& files, const render::HostScene& host,
             const render::Parts& parts)
      : device_(device), scene_(device, host, parts), lanes_(parts.lanes),
        program_(device::build(device, files, parts.source("measure/rays.cl"))) {}

  // Returns the seconds of the kernel by the clock of the device.
  double run(const char* kernel_name, const std::vector<Ray>& rays, std::vector<float>& found) {
    const cl::Buffer in(device_.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, rays.size() * sizeof(Ray),
                        const_cast<Ray*>(rays.data()));
    const cl::Buffer out(device_.context, CL_MEM_WRITE_ONLY, found.size() * sizeof(float));
    device::Kernel kernel(program_, kernel_name);
    scene_.bind(kernel);
    kernel.set("rays", in);
    kernel.set("ray_count", static_cast<cl_int>(rays.size()));
    kernel.set("found", out);
    const std::size_t items =
        lanes_ == 1 && device_.info.type != "cpu" ? (rays.size() + 7) / 8 : device_.info.compute_units * 8;
    const std::size_t local = lanes_ == 1 ? std::min<std::size_t>(64, items) : 1;
    cl::Event done;
    device_.queue.enqueueNDRangeKernel(kernel.ready(), cl::NullRange, cl::NDRange(items / local * local),
                                       cl::NDRange(local), nullptr, &done);
    device_.queue.enqueueReadBuffer(out, CL_TRUE, 0, found.size() * sizeof(float), found.data());
    return 1e-9 * static_cast<double>(done.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                      done.getProfilingInfo<CL_PROFILING_COMMAND_START>());
  }

private:
  device::Device device_;
  render::DeviceScene scene_;
  int lanes_;
  device::BuiltProgram program_;
};

// ---- Rays

Ray make_ray(const Vec3& origin, const Vec3& direction, double distance) {
  Ray ray{};
  for (int axis = 0; axis < 3; ++axis) {
    ray.origin[axis] = static_cast<float>(origin[axis]);
    ray.direction[axis] = static_cast<float>(direction[axis]);
  }
  ray.distance = static_cast<float>(distance);
  return ray;
}

std::vector<Ray> camera_rays(const scene::Camera& camera, const Vec3& origin) {
  std::vector<Ray> rays;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const double u = 1 - 2 * (x + 0.5) / camera.width, v = 1 - 2 * (y + 0.5) / camera.height;
      rays.push_back(make_ray(
          camera.position - origin,
          glm::normalize(camera.forward + camera.tan_half_fov_x * (u * camera.left + v * camera.up)), 0));
    }
  return rays;
}

// From a point just before each hit: a ray with a direction uniform over the sphere, and a shadow ray to a
// random point below the ceiling.
struct SecondaryRays {
  std::vector<Ray> bounce, shadow;
};

SecondaryRays secondary_rays(const std::vector<Ray>& camera, const std::vector<float>& distances) {
  SecondaryRays rays;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (std::size_t i = 0; i < camera.size(); ++i) {
    if (!std::isfinite(distances[i])) continue;
    const Ray& r = camera[i];
    const Vec3 origin(r.origin[0], r.origin[1], r.origin[2]),
        direction(r.direction[0], r.direction[1], r.direction[2]);
    const Vec3 point = origin + 0.9999 * distances[i] * direction;
    const double z = 1 - 2 * uniform(generator), phi = 2 * std::numbers::pi * uniform(generator),
                 s = std::sqrt(1 - z * z);
    rays.bounce.push_back(make_ray(point, {s * std::cos(phi), s * std::sin(phi), z}, 0));
    const Vec3 to_light = Vec3(uniform(generator) - 0.5, 4.9, uniform(generator) - 0.5) - point;
    rays.shadow.push_back(make_ray(point, glm::normalize(to_light), 0.999 * glm::length(to_light)));
  }
  return rays;
}

// Largest share of rays whose results may differ: at edges one may hit what the other misses.
constexpr double allowed_difference = 1e-3;

void check_agreement(const std::vector<float>& found, const std::vector<float>& expected) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool both_miss = !std::isfinite(found[i]) && !std::isfinite(expected[i]);
    if (!both_miss && !(std::abs(found[i] - expected[i]) <= 1e-3f * std::max(1.0f, expected[i]))) ++different;
  }
  if (static_cast<double>(different) > allowed_difference * static_cast<double>(found.size()))
    throw DeviceError(
        fmt::format("{} of {} rays have other results than Embree's: the rates cannot be compared", different,
                    found.size()));
}

constexpr const char* columns =
    "scene,triangles,kind,device,layout,mrays_per_s,embree_mrays_per_s,ratio,embree_call";

void print_line(CsvFile& table, const std::string& text) {
  table.line(text);
  say("{}\n", text);
}

struct Kind {
  const char* name;
  const char* kernel;
  const std::vector<Ray>& rays;
};

void measure(CsvFile& table, const RaysOptions& options, const std::string& label, DeviceRays& device,
             const EmbreeRays& embree, const Kind& kind) {
  const bool closest = std::string(kind.kernel) == "find_closest";
  std::vector<float> found(kind.rays.size()), expected(kind.rays.size());
  std::vector<double> rates, embree_rates, ratios;
  for (int round = 0; round < options.rounds; ++round) {
    const double a = device.run(kind.kernel, kind.rays, found);
    const double b =
        seconds_of([&] { closest ? embree.closest(kind.rays, expected) : embree.any(kind.rays, expected); });
    const double count = 1e-6 * static_cast<double>(kind.rays.size());
    rates.push_back(count / a), embree_rates.push_back(count / b), ratios.push_back(b / a);
  }
  check_agreement(found, expected);
  print_line(table, fmt::format("{},{:.3f},{:.3f},{:.3f},{}", fmt::format(fmt::runtime(label), kind.name),
                                measure::median(rates), measure::median(embree_rates),
                                measure::median(ratios), closest ? "rtcIntersect1" : "rtcOccluded1"));
}

} // namespace

void measure_rays(const RaysOptions& options) {
  CsvFile table(options.folder, "rays.csv", columns);
  say("{}\n", columns);
  const device::Device device = device::open_devices(options.devices).front();
  const sources::KernelFiles files(options.kernel_dir);
  const int lanes = options.lanes_on(device.info);
  for (const std::uint64_t triangles : options.triangles) {
    const scene::Scene scene = knot_scene(triangles);
    render::Settings settings;
    settings.traversal = options.traversal;
    render::HostScene host = render::prepare(scene, settings, lanes);
    const render::Parts parts = render::find_parts(scene, *host.geometry, host.lights, settings, lanes);
    DeviceRays device_rays(device, files, host, parts);
    const EmbreeRays embree_rays(scene.meshes.front(), host.geometry->origin, device.info.compute_units);
    const std::vector<Ray> camera = camera_rays(scene.camera, host.geometry->origin);
    std::vector<float> distances(camera.size());
    embree_rays.closest(camera, distances);
    const SecondaryRays secondary = secondary_rays(camera, distances);
    const std::string layout = fmt::format("{} x{}", parts.hierarchy ? "bvh" : "brute", lanes);
    const std::string label = fmt::format("knot,{},{{}},{},{}", scene.meshes.front().triangles.size(),
                                          csv_value(device.info.name), layout);
    for (const Kind& kind :
         {Kind{"camera", "find_closest", camera}, Kind{"bounce", "find_closest", secondary.bounce},
          Kind{"shadow", "find_any", secondary.shadow}})
      measure(table, options, label, device_rays, embree_rays, kind);
  }
  std::string command = "phlux bench rays --triangles ";
  for (const std::uint64_t triangles : options.triangles)
    command += fmt::format("{}{}", command.ends_with(' ') ? "" : ",", triangles);
  write_provenance(options.folder, "rays",
                   {command, device.info, lanes, "timings exclude building kernels", "1"});
  draw_charts(options.folder, "rays");
}

} // namespace phlux::bench
