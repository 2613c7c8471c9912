#include "render/render.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "clock.h"
#include "device/program.h"
#include "errors.h"
#include "render/error_target.h"
#include "render/launcher.h"
#include "render/programs.h"

namespace phlux::render {
namespace {

// Launches in flight on a device: one runs while the results of the previous one are added to the film.
constexpr std::size_t launches_in_flight = 2;

// One device, ready to render.
struct Worker {
  Parts parts;
  std::unique_ptr<Launcher> launcher;
};

void add(const Counts& counts, Counts& to) {
  to.paths += counts.paths;
  to.rays += counts.rays;
  to.shadow_rays += counts.shadow_rays;
  to.nonfinite += counts.nonfinite;
  if (!to.first_nonfinite) to.first_nonfinite = counts.first_nonfinite;
}

// The work that devices share. Taking a launch and adding its results to the film are serialized by a lock.
class DispatchLoop {
public:
  DispatchLoop(const Settings& settings, film::Film& film, const Events& events, const RenderState& from)
      : settings_(settings), film_(film), events_(events), begin_(Clock::now()),
        seconds_before_(from.seconds_render), open_ended_(settings.time_limit || settings.target_error),
        schedule_(static_cast<std::int64_t>(film.pixels().size()),
                  open_ended_ ? std::nullopt : std::optional<std::int64_t>(settings.samples_per_pixel),
                  from.position),
        counts_(from), started_paths_(from.paths) {
    if (settings.target_error) target_.emplace(*settings.target_error, film.pixels().size());
    ended_ = from.paths > 0 && precise_enough();
  }

  // Runs one device until the work is done or ended; reports progress after each launch.
  void run(Launcher& launcher) {
    while (true) {
      while (launcher.in_flight() < launches_in_flight && take(launcher)) {
      }
      if (launcher.in_flight() == 0) return;
      launcher.settle();
      const std::lock_guard lock(mutex_);
      launcher.collect(film_);
      add(launcher.take_counts(), counts_);
      in_flight_[&launcher].pop_front();
      if (!ended_) ended_ = precise_enough() || !report();
    }
  }

  // Ends the render on every device.
  void end() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }

  [[nodiscard]] double seconds() const { return seconds_before_ + seconds_since(begin_); }

  // The state that belongs to the film.
  [[nodiscard]] RenderState state() const {
    RenderState state{counts_, schedule_.position(), seconds()};
    std::vector<Launch>& missing = state.position.missing;
    for (const auto& [launcher, launches] : in_flight_)
      missing.insert(missing.begin(), launches.begin(), launches.end());
    return state;
  }

private:
  bool take(Launcher& launcher) {
    const std::lock_guard lock(mutex_);
    if (ended_ || (settings_.time_limit && seconds() >= *settings_.time_limit)) return false;
    if (target_ && launcher.in_flight() > 0 && paths_left() <= 0) return false;
    auto launch = schedule_.next([&](std::int64_t left, int samples) {
      if (target_) left = std::clamp<std::int64_t>(paths_left() / samples, 1, left);
      return launcher.wanted_jobs(left, samples);
    });
    if (!launch) return false;
    started_paths_ += static_cast<std::uint64_t>(launch->jobs * launch->block_samples);
    in_flight_[&launcher].push_back(*launch);
    launch->first_sample += settings_.first_sample;
    launcher.enqueue(*launch);
    return true;
  }

  bool report() const {
    if (!events_.progress) return true;
    Progress progress;
    progress.samples_done = static_cast<double>(counts_.paths) / static_cast<double>(film_.pixels().size());
    if (!open_ended_) progress.samples_total = settings_.samples_per_pixel;
    progress.seconds = seconds();
    progress.paths = counts_.paths;
    progress.state = [this] { return state(); };
    return events_.progress(progress);
  }

  bool precise_enough() { return target_ && target_->reached(film_, counts_.paths); }

  // Until the requested error, as far as is known.
  [[nodiscard]] std::int64_t paths_left() const {
    return static_cast<std::int64_t>(
        std::ceil(target_->wanted_paths() - static_cast<double>(started_paths_)));
  }

  const Settings& settings_;
  film::Film& film_;
  const Events& events_;
  Clock::time_point begin_;
  double seconds_before_;
  bool open_ended_;
  Schedule schedule_;
  std::map<const Launcher*, std::deque<Launch>> in_flight_;
  std::mutex mutex_;
  Counts counts_;
  std::uint64_t started_paths_;
  std::optional<ErrorTarget> target_;
  bool ended_ = false;
};

void check_samples(const Settings& settings) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max(); // of the kernels' int
  if (settings.samples_per_pixel < 1)
    throw UsageError(fmt::format("{} samples per pixel: at least 1 is needed", settings.samples_per_pixel));
  if (settings.first_sample + settings.samples_per_pixel > most)
    throw UsageError(fmt::format("`first-sample` {}: samples are numbered up to {}: begin earlier",
                                 settings.first_sample, most));
}

// The unit of the film's sums depends on the scene's lights.
void set_unit(film::Film& film, double unit) {
  if (film.contributors() > 0 && film.unit() != unit)
    throw SceneError(
        "the samples so far are in another unit: go on with the version of phlux that made them");
  film.set_unit(unit);
}

// A path that never ends would keep its kernel running forever.
void check_paths_end(const scene::Scene& scene, const Settings& settings) {
  constexpr double nearly_all = 0.999;
  if (settings.rr_depth >= 0 || settings.max_depth >= 0) return;
  for (const scene::Material& m : scene.materials)
    if (lobes::largest_reflectance(m) >= nearly_all)
      throw UsageError(
          "`rr-depth` -1 `max-depth` -1: a material reflects everything, and nothing would end a path in a "
          "closed room: give one of the two");
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
  const auto anisotropic = [&](const auto& shape) {
    const scene::Material& m = scene.materials[static_cast<std::size_t>(shape.surface.material)];
    return m.model == lobes::shipped("anisotropicphong") && m.value("exponent_u") != m.value("exponent_v");
  };
  if (std::any_of(scene.meshes.begin(), scene.meshes.end(), anisotropic))
    events.warning(
        "anisotropicphong on a mesh: texture coordinates are not read, and exponentU is along each "
        "triangle's first edge: use rectangle, cube or disk, whose axes toWorld turns, or equal "
        "exponents");
  if (std::any_of(scene.spheres.begin(), scene.spheres.end(), anisotropic))
    events.warning(
        "anisotropicphong on a sphere: toWorld does not turn it, and exponentU is along the circles "
        "about the world's z axis: use equal exponents where that matters");
  const auto is_delta = [](const scene::Material& m) { return m.model->has_delta; };
  if (settings.integrator == "light" && std::any_of(scene.materials.begin(), scene.materials.end(), is_delta))
    events.warning(
        "light tracing shows mirrors and smooth glass black: no light path can be connected from one to the "
        "camera: use `integrator` path or bidir where one is in view");
  if (settings.strategy == "lobe-estimate-printed")
    events.warning("`strategy` lobe-estimate-printed is biased: it loses light at grazing angles; "
                   "lobe-estimate does not");
}

// Builds the scene's program for each device. The tables for one WIDTH serve every device of that WIDTH.
class WorkerFactory {
public:
  WorkerFactory(const scene::Scene& scene, const Settings& settings, const Events& events)
      : scene_(scene), settings_(settings), events_(events) {}

  // The radiance that is 1 in the devices' sums.
  [[nodiscard]] double unit() const { return host_->lights.unit; }

  [[nodiscard]] bool shines() const { return host_->lights.shines(); }

  Worker make(Programs& programs, Statistics& statistics) {
    const device::Device& device = programs.device();
    const int lanes = lanes_for(device.info, settings_);
    const Clock::time_point begin = Clock::now();
    if (!host_ || lanes_ != lanes)
      host_ = prepare(scene_, settings_.traversal, lanes_ = lanes, settings_.double_precision,
                      wants_light_tree(settings_));
    Worker worker;
    worker.parts = find_parts(scene_, host_->geometry, host_->lights, settings_, lanes);
    if (events_.warning) warn(worker.parts);
    statistics.seconds_setup += seconds_since(begin);
    const device::BuiltProgram built = programs.program(worker.parts, events_.building_kernels);
    statistics.kernels_from_cache = built.from_cache;
    statistics.portable_lanes = device::portable_lanes(device);
    worker.launcher = std::make_unique<Launcher>(device, built, *host_, worker.parts, settings_);
    const Clock::time_point warm_up_begin = Clock::now();
    worker.launcher->warm_up();
    statistics.seconds_build_kernels += built.seconds + seconds_since(warm_up_begin);
    return worker;
  }

private:
  // Warnings that depend on the scene's tables.
  void warn(const Parts& parts) const {
    if (!host_->lights.shines())
      events_.warning("no light of the scene has any power: the image will be black");
    for (const char* name : {"uniform", "theta-phi", "disk", "rejection"})
      if (settings_.strategy == name && !parts.has_model("phong"))
        events_.warning(fmt::format(
            "`strategy` {}: no surface has a phong lobe, so directions are drawn by the cosine", name));
    if (settings::is_strategy_file(settings_.strategy) && !parts.has_model("phong"))
      events_.warning(
          fmt::format("`strategy` {}: no surface has a phong lobe, so it has no effect", settings_.strategy));
    // Squared ratios of areas leave float's range: for other sizes the weights do not add up to 1.
    constexpr double smallest = 1e-6, largest = 1e5;
    const double radius = host_->geometry.radius;
    if (settings_.integrator == "bidir" && settings_.weights == Weights::power &&
        !settings_.double_precision && (radius < smallest || radius > largest))
      events_.warning(fmt::format(
          "`weights` power: the scene's radius is {:.1g}, and the weights are right between {:g} and "
          "{:g}: use `weights` balance",
          radius, smallest, largest));
  }

  const scene::Scene& scene_;
  const Settings& settings_;
  const Events& events_;
  std::optional<HostScene> host_;
  int lanes_ = 0;
};

void add_names(Statistics& statistics, const device::DeviceInfo& device) {
  statistics.device += (statistics.device.empty() ? "" : ", ") + device.name;
  statistics.driver += (statistics.driver.empty() ? "" : ", ") + device.driver;
}

// Runs the first device in the caller's thread and each other in a thread of its own. A failure ends the
// render.
void run_all(DispatchLoop& loop, std::vector<Worker>& workers) {
  std::vector<std::exception_ptr> failures(workers.size());
  const auto run = [&](std::size_t i) {
    try {
      loop.run(*workers[i].launcher);
    } catch (...) {
      failures[i] = std::current_exception();
      loop.end();
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < workers.size(); ++i) others.emplace_back(run, i);
    run(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

// Calls `work`; an error of OpenCL becomes a DeviceError.
template<class Work>
auto reporting_device_errors(const Work& work) try {
  return work();
} catch (const cl::Error& error) {
  throw DeviceError(fmt::format("{} failed: {}", error.what(), device::error_name(error.err())));
}

} // namespace

struct Renderer::Ready {
  std::vector<Worker> workers;
  Statistics statistics; // of the set-up
  double unit = 1;       // of the film's sums

  void prepare(const std::vector<Programs*>& devices, const scene::Scene& scene, const Settings& settings,
               const Events& events) {
    WorkerFactory factory(scene, settings, events);
    for (Programs* programs : devices) {
      workers.push_back(factory.make(*programs, statistics));
      add_names(statistics, programs->device().info);
    }
    const Parts& parts = workers.front().parts;
    statistics.lanes = parts.lanes;
    statistics.traversal = parts.hierarchy ? "bvh" : "brute";
    statistics.parts = parts.names();
    statistics.shines = factory.shines();
    unit = factory.unit();
  }
};

Renderer::Renderer(const scene::Scene& scene, const Settings& settings, const Events& events)
    : ready_(std::make_unique<Ready>()) {
  reporting_device_errors([&] {
    check(scene, settings);
    warn(scene, settings, events);
    std::deque<Programs> of_devices;
    std::vector<Programs*> devices;
    for (const device::Device& device : device::open_devices(settings.devices))
      devices.push_back(&of_devices.emplace_back(device, sources::KernelFiles(settings.kernel_dir)));
    ready_->prepare(devices, scene, settings, events);
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

Statistics Renderer::render(const Settings& settings, film::Film& film, const Events& events,
                            const RenderState& from) {
  return reporting_device_errors([&] {
    check_samples(settings);
    set_unit(film, ready_->unit);
    if (settings.clamp) film.set_clamp(*settings.clamp);
    if (settings.techniques) film.use_techniques();
    for (const Worker& worker : ready_->workers) worker.launcher->begin(settings);
    DispatchLoop loop(settings, film, events, from);
    run_all(loop, ready_->workers);
    Statistics statistics = ready_->statistics;
    static_cast<RenderState&>(statistics) = loop.state();
    return statistics;
  });
}

Statistics render(const scene::Scene& scene, const Settings& settings, film::Film& film, const Events& events,
                  const RenderState& from) {
  return Renderer(scene, settings, events).render(settings, film, events, from);
}

} // namespace phlux::render
