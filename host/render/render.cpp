#include "render/render.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "clock.h"
#include "device/driver_cache.h"
#include "device/program.h"
#include "errors.h"
#include "render/dispatch.h"
#include "render/launcher.h"
#include "render/programs.h"

namespace phlux::render {
namespace {

// One device, ready to render.
struct Worker {
  Parts parts;
  std::unique_ptr<Launcher> launcher;
};

void check_samples(const Settings& settings) {
  if (settings.samples_per_pixel < 1)
    throw UsageError(fmt::format("{} samples per pixel: at least 1 is needed", settings.samples_per_pixel));
  if (settings.first_sample + settings.samples_per_pixel > settings::most_samples)
    throw UsageError(fmt::format("`first-sample` {}: samples are numbered up to {}: begin earlier",
                                 settings.first_sample, settings::most_samples));
}

// The unit of the film's sums depends on the scene's lights.
void set_unit(film::Film& film, double unit) {
  if (film.contributors() > 0 && film.unit() != unit)
    throw SceneError(
        "the samples of the checkpoint are in another unit: use the version of phlux that wrote it");
  film.set_unit(unit);
}

// A path that never ends would keep its kernel running forever.
void check_paths_end(const scene::Scene& scene, const Settings& settings) {
  constexpr double nearly_all = 0.999;
  if (settings.rr_depth >= 0 || settings.max_depth >= 0) return;
  for (const scene::Material& m : scene.materials)
    if (lobes::largest_reflectance(m) >= nearly_all)
      throw UsageError(
          "`rr-depth` -1 `max-depth` -1: a material reflects all light, so that a path in a closed room "
          "would never end: set one of the two");
}

void check(const scene::Scene& scene, const Settings& settings) {
  check_samples(settings);
  check_paths_end(scene, settings);
}

// Warns of valid settings that may surprise with this scene.
void warn(const scene::Scene& scene, const Settings& settings, const Events& events) {
  if (!events.warning) return;
  const std::size_t lost =
      scene.point_lights.size() + scene.spot_lights.size() + scene.directional_lights.size();
  if (settings.integrator == "path" && settings.connect == Connect::none && lost > 0)
    events.warning(
        fmt::format("`connect` none: no path can hit a point, spot or directional light: {} of the "
                    "scene's lights are dark",
                    lost));
  if (settings.integrator == "light" && scene::has_delta(scene))
    events.warning(
        "light tracing shows mirrors and smooth glass black, because they cannot be connected to the camera: "
        "use `integrator` path or bidir if one is in view");
  if (settings.strategy == "lobe-estimate-printed")
    events.warning("`strategy` lobe-estimate-printed is biased: it loses light at grazing angles; "
                   "lobe-estimate does not");
}

// Builds the scene's program for each device. The tables for one WIDTH serve every device of that WIDTH.
class WorkerFactory {
public:
  WorkerFactory(const scene::Scene& scene, const Settings& settings, const Events& events,
                tables::KnownGeometry* known)
      : scene_(scene), settings_(settings), events_(events), known_(known) {}

  // The radiance that is 1 in the devices' sums.
  [[nodiscard]] double unit() const { return host_->lights.unit; }

  [[nodiscard]] bool shines() const { return host_->lights.shines(); }

  Worker make(Programs& programs, Statistics& statistics) {
    const device::Device& device = programs.device();
    const int lanes = lanes_for(device.info, settings_);
    const Clock::time_point begin = Clock::now();
    const bool is_first = !host_;
    if (is_first || lanes_ != lanes) host_ = prepare(scene_, settings_, lanes_ = lanes, known_);
    Worker worker;
    worker.parts = find_parts(scene_, *host_->geometry, host_->lights, settings_, lanes);
    if (events_.warning) warn(worker.parts);
    statistics.seconds_setup += seconds_since(begin);
    const device::BuiltProgram built = programs.program(worker.parts, events_.building_kernels);
    statistics.kernels_from_cache = built.from_cache && (is_first || statistics.kernels_from_cache);
    statistics.portable_lanes = device::portable_lanes(device) || (!is_first && statistics.portable_lanes);
    const Clock::time_point warm_up_begin = Clock::now();
    worker.launcher = launcher(device, built, worker.parts);
    device::record_driver_cache();
    statistics.seconds_build_kernels += built.seconds + seconds_since(warm_up_begin);
    return worker;
  }

private:
  // Tries a second time if the device fails.
  [[nodiscard]] std::unique_ptr<Launcher> launcher(const device::Device& device,
                                                   const device::BuiltProgram& built, const Parts& parts,
                                                   bool again = true) const {
    try {
      auto made = std::make_unique<Launcher>(device, built, *host_, parts, settings_);
      made->warm_up();
      return made;
    } catch (...) {
      if (!again || !current_failure()) throw;
    }
    pause(settings_);
    return launcher(device, built, parts, false);
  }

  // Warnings that depend on the scene's tables.
  void warn(const Parts& parts) const {
    if (scene::has_lights(scene_) && !host_->lights.shines()) // reading a scene without lights has warned
      events_.warning("no light of the scene has any power: the image will be black");
    for (const char* name : {"uniform", "theta-phi", "disk", "rejection"})
      if (settings_.strategy == name && !parts.has_model("phong"))
        events_.warning(fmt::format(
            "`strategy` {}: no surface has a phong lobe, so directions are sampled by the cosine", name));
    if (settings::is_strategy_file(settings_.strategy) && !parts.has_model("phong"))
      events_.warning(
          fmt::format("`strategy` {}: no surface has a phong lobe, so it has no effect", settings_.strategy));
    // Squared ratios of areas leave float's range: for other sizes the weights do not add up to 1.
    constexpr double smallest = 1e-6, largest = 1e5;
    const double radius = host_->geometry->radius;
    if (settings_.integrator == "bidir" && settings_.weights == Weights::power &&
        !settings_.double_precision && (radius < smallest || radius > largest))
      events_.warning(fmt::format("`weights` power: the radius of the scene is {:.1g}, but the weights are "
                                  "accurate only if it is from "
                                  "{:g} to {:g}: use `weights` balance",
                                  radius, smallest, largest));
  }

  const scene::Scene& scene_;
  const Settings& settings_;
  const Events& events_;
  tables::KnownGeometry* known_;
  std::optional<HostScene> host_;
  int lanes_ = 0;
};

// Threads that add results to the film. Those of CPU devices compete for the same cores, and several adding
// threads take more processor time than one. One is therefore enough until its share of the time is 1.5
// cores; then twice as many take part as have that share. If other processes trace too, half of the cores
// add; beside a GPU all of them.
std::size_t folding_threads(const std::vector<Worker>& workers, bool other_processes) {
  constexpr double most = 16.0; // each looks through the records of all
  double share = 0.03;          // of one thread's adding in the processor time of all (bench/PERFORMANCE.md)
  const settings::IntegratorInfo& integrator = settings::info_of(workers.front().parts.integrator);
  if (integrator.light_paths) share = integrator.eye_paths ? 0.11 : 0.25;
  double cores = 0.0;
  bool gpu = false;
  for (const Worker& worker : workers) {
    const device::DeviceInfo& device = worker.launcher->device();
    gpu = gpu || device.type != "cpu";
    cores += device.compute_units;
  }
  double threads = share * cores < 1.5 ? 1.0 : 2.0 * share * cores;
  if (other_processes) threads = cores / 2.0;
  if (gpu) threads = std::thread::hardware_concurrency();
  return static_cast<std::size_t>(std::clamp(threads, 1.0, most));
}

void add_names(Statistics& statistics, const device::DeviceInfo& device) {
  statistics.device += (statistics.device.empty() ? "" : ", ") + device.name;
  statistics.driver += (statistics.driver.empty() ? "" : ", ") + device.driver;
}

// Calls `work`; an error of OpenCL becomes a DeviceError.
template<class Work>
auto reporting_device_errors(const Work& work) try {
  return work();
} catch (const cl::Error& error) {
  throw DeviceError(device::describe(error));
}

} // namespace

struct Renderer::Ready {
  std::vector<Worker> workers;
  Statistics statistics; // of the set-up
  double unit = 1;       // of the film's sums

  void prepare(const std::vector<Programs*>& devices, const scene::Scene& scene, const Settings& settings,
               const Events& events, tables::KnownGeometry* known = nullptr) {
    WorkerFactory factory(scene, settings, events, known);
    for (Programs* programs : devices) {
      const device::DeviceInfo& device = programs->device().info;
      try {
        workers.push_back(factory.make(*programs, statistics));
        add_names(statistics, device);
      } catch (...) {
        const std::optional<Failure> failure = current_failure();
        if (!failure || (workers.empty() && programs == devices.back())) throw;
        if (events.warning)
          events.warning(fmt::format("{}: {}: it is left out", name_of(device), failure->text));
      }
    }
    const Parts& parts = workers.front().parts;
    statistics.lanes = parts.lanes;
    statistics.traversal = parts.hierarchy ? "bvh" : "brute";
    statistics.parts = parts.names();
    statistics.shines = factory.shines();
    unit = factory.unit();
  }
};

Renderer::Renderer(const scene::Scene& scene, const Settings& settings, const Events& events,
                   tables::KnownGeometry* known)
    : ready_(std::make_unique<Ready>()) {
  reporting_device_errors([&] {
    check(scene, settings);
    warn(scene, settings, events);
    std::deque<Programs> of_devices;
    std::vector<Programs*> devices;
    for (const device::Device& device : device::open_devices(settings.devices, settings.threads))
      devices.push_back(&of_devices.emplace_back(device, sources::KernelFiles(settings.kernel_dir)));
    ready_->prepare(devices, scene, settings, events, known);
  });
}

Renderer::Renderer(Programs& programs, const scene::Scene& scene, const Settings& settings)
    : ready_(std::make_unique<Ready>()) {
  reporting_device_errors([&] {
    check(scene, settings);
    ready_->prepare({&programs}, scene, settings, {});
  });
}

Renderer::~Renderer() = default;

std::vector<Processor*> Renderer::processors() const {
  std::vector<Processor*> processors;
  for (const Worker& worker : ready_->workers) processors.push_back(worker.launcher.get());
  return processors;
}

Statistics Renderer::render(const Settings& settings, film::Film& film, const Events& events,
                            const RenderState& from, const std::vector<Processor*>& others) {
  return reporting_device_errors([&] {
    check_samples(settings);
    set_unit(film, ready_->unit);
    if (settings.clamp) film.set_clamp(*settings.clamp);
    if (settings.ambient) film.use_signed_contributions();
    if (settings.techniques) film.use_techniques();
    if (samples_point_sets(settings)) film.use_dependent_samples();
    std::vector<Processor*> all = processors();
    all.insert(all.end(), others.begin(), others.end());
    DispatchLoop loop(settings, film, events, from, folding_threads(ready_->workers, !others.empty()));
    loop.run(all);
    Statistics statistics = ready_->statistics;
    static_cast<RenderState&>(statistics) = loop.state();
    if (!loop.failure().empty()) throw DevicesFailed(loop.failure(), statistics);
    return statistics;
  });
}

Statistics render(const scene::Scene& scene, const Settings& settings, film::Film& film, const Events& events,
                  const RenderState& from, const std::vector<Processor*>& others,
                  tables::KnownGeometry* known) {
  std::optional<DevicesFailed> failure;
  try {
    return Renderer(scene, settings, events, known).render(settings, film, events, from, others);
  } catch (const DevicesFailed& first) {
    failure = first;
  }
  while (true) {
    pause(settings);
    device::reopen_devices();
    std::optional<Renderer> renderer;
    try {
      renderer.emplace(scene, settings, Events()); // the first has warned of the scene
    } catch (const std::exception&) {
      throw DevicesFailed(*failure);
    }
    try {
      return renderer->render(settings, film, events, failure->statistics, others);
    } catch (const DevicesFailed& next) {
      if (next.statistics.paths == failure->statistics.paths) throw;
      failure = next;
    }
  }
}

} // namespace phlux::render
