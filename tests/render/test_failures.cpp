// Renders during which calls of OpenCL and allocations fail: the film is that of a render without failures.
#include <cstdlib>
#include <new>
#include <optional>
#include <set>

#include <catch2/catch.hpp>

#include "device/device.h"
#include "device/environment.h"
#include "device/opencl.h"
#include "device/program.h"
#include "faults/device.h"
#include "images/scenes.h"
#include "render/outline.h"
#include "render/render.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::test;

namespace {

// Large allocations of this thread until one fails; -1: none does.
thread_local int allocations_left = -1;
constexpr std::size_t large = 2048; // bytes: the sums of the first launch

constexpr int width = 23, height = 17; // no WIDTH divides the number of pixels
constexpr long always = 1L << 40;

const scene::Scene& box() {
  static const scene::Scene scene = shipped("cornell-box", width, height);
  return scene;
}

// Launches as short as possible, so that their number does not depend on the time.
render::Settings settings_of(const std::string& integrator, int samples = 48) {
  render::Settings settings = settings_for(samples, 6);
  settings.integrator = integrator;
  settings.launch_seconds = 1e-9;
  settings.pause_seconds = 0;
  return settings;
}

struct Outcome {
  film::Film film{width, height};
  render::Statistics statistics;
  std::vector<std::string> warnings;
  bool failed = false; // on every device
};

render::Events events_of(Outcome& outcome) {
  render::Events events;
  events.warning = [&](const std::string& text) { outcome.warnings.push_back(text); };
  return events;
}

Outcome render_by(render::Renderer& renderer, const render::Settings& settings,
                  std::optional<Outcome> from = {}) {
  Outcome outcome = from ? std::move(*from) : Outcome();
  outcome.failed = false;
  try {
    outcome.statistics = renderer.render(settings, outcome.film, events_of(outcome), outcome.statistics);
  } catch (const render::DevicesFailed& failure) {
    outcome.failed = true;
    outcome.statistics = failure.statistics;
  }
  return outcome;
}

// Bit for bit.
bool same(const Outcome& a, const Outcome& b) {
  for (std::size_t pixel = 0; pixel < a.film.pixels().size(); ++pixel)
    if (a.film.mean(pixel) != b.film.mean(pixel) ||
        a.film.variance_of_mean(pixel) != b.film.variance_of_mean(pixel))
      return false;
  return a.statistics.paths == b.statistics.paths && a.statistics.rays == b.statistics.rays &&
         a.statistics.shadow_rays == b.statistics.shadow_rays;
}

void no_faults() {
  faults::plan_device_fault("", 0, 0, 0);
}

} // namespace

// Not inlined, as GCC then takes them for a mismatch of new with free() and malloc() with delete.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  if (bytes >= large && allocations_left > 0 && --allocations_left == 0) throw std::bad_alloc();
  if (void* const memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
// AddressSanitizer has its own.
[[gnu::noinline]] void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return std::malloc(bytes);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

TEST_CASE("whichever call fails, first, in the middle or last, the film is the same") {
  const std::string integrator = GENERATE("path", "light", "bidir");
  const render::Settings settings = settings_of(integrator);
  render::Renderer renderer(box(), settings, {});
  no_faults();
  const Outcome whole = render_by(renderer, settings);
  REQUIRE_FALSE(whole.failed);
  REQUIRE(faults::device_calls("clEnqueueNDRangeKernel") > 10);

  std::vector<std::string> calls = {
      "clEnqueueNDRangeKernel", "clEnqueueReadBuffer", "clWaitForEvents", "clGetEventProfilingInfo",
      "clGetEventInfo",         "clSetKernelArg",      "clFlush"};
  if (integrator != "path") calls.insert(calls.end(), {"clEnqueueMapBuffer", "clEnqueueUnmapMemObject"});
  for (const std::string& call : calls) {
    no_faults();
    static_cast<void>(render_by(renderer, settings));
    const long count = faults::device_calls(call);
    for (const long first : {0L, count / 2, count - 1}) {
      CAPTURE(integrator, call, count, first);
      faults::plan_device_fault(call, first, 1, CL_INVALID_COMMAND_QUEUE);
      const Outcome once = render_by(renderer, settings);
      CHECK(faults::device_faults() == 1);
      CHECK_FALSE(once.failed);
      CHECK(same(once, whole));
      const bool harmless = call == "clGetEventProfilingInfo" || call == "clEnqueueUnmapMemObject";
      CHECK(once.warnings.size() == (harmless ? 0 : 1));
    }
  }
}

TEST_CASE("a device that fails for good leaves the film so far, from which the render resumes") {
  const std::string integrator = GENERATE("path", "bidir");
  const render::Settings settings = settings_of(integrator);
  const Outcome whole = [&] {
    no_faults();
    render::Renderer renderer(box(), settings, {});
    return render_by(renderer, settings);
  }();
  for (const cl_int code : {CL_OUT_OF_RESOURCES, CL_INVALID_CONTEXT})
    for (const std::string call :
         {"clEnqueueNDRangeKernel", "clEnqueueReadBuffer", "clWaitForEvents", "clFlush"}) {
      CAPTURE(integrator, code, call);
      const long mapped = faults::mapped_buffers();
      std::optional<render::Renderer> renderer;
      renderer.emplace(box(), settings, render::Events());
      faults::plan_device_fault(call, call == "clEnqueueReadBuffer" ? 14 : 8, always, code);
      const Outcome part = render_by(*renderer, settings);
      CHECK(part.failed);
      CHECK(part.statistics.paths > 0);
      CHECK(part.statistics.paths < whole.statistics.paths);
      CHECK_FALSE(part.statistics.position.missing.empty());
      CHECK_THAT(part.warnings.front(), Catch::Contains(call) && Catch::Contains("repeated"));
      CHECK_THAT(part.warnings.back(), Catch::Contains("given up"));
      no_faults();
      CHECK(same(render_by(*renderer, settings, part), whole));
      renderer.reset();
      CHECK(faults::mapped_buffers() == mapped);
    }
}

TEST_CASE("where new contexts help, a render continues with them") {
  const render::Settings settings = settings_of("path");
  Outcome whole, outcome;
  no_faults();
  whole.statistics = render::render(box(), settings, whole.film, {});
  faults::plan_device_fault("clFlush", 20, 2, CL_INVALID_CONTEXT); // once too often for one context
  outcome.statistics = render::render(box(), settings, outcome.film, events_of(outcome));
  CHECK_THAT(outcome.warnings.back(), Catch::Contains("given up"));
  CHECK(same(outcome, whole));

  faults::plan_device_fault("clFlush", 20, always, CL_INVALID_CONTEXT);
  CHECK_THROWS_AS(render::render(box(), settings, outcome.film, {}), render::DevicesFailed);
  no_faults();
}

TEST_CASE("a failure while a render is set up is not its end") {
  const render::Settings settings = settings_of("path");
  for (const char* call :
       {"clCreateBuffer", "clCreateKernel", "clSetKernelArg", "clEnqueueNDRangeKernel", "clFinish"}) {
    CAPTURE(call);
    faults::plan_device_fault(call, 0, 1, CL_OUT_OF_HOST_MEMORY);
    Outcome outcome;
    CHECK_NOTHROW(render::render(box(), settings, outcome.film, {}));
    CHECK(faults::device_faults() == 1);
  }
  faults::plan_device_fault("clEnqueueNDRangeKernel", 0, always, CL_OUT_OF_RESOURCES);
  film::Film film(width, height);
  CHECK_THROWS_AS(render::render(box(), settings, film, {}), DeviceError);
  no_faults();
}

// Before a device has rendered anything there is nothing to lose.
TEST_CASE(
    "whichever call fails while a device is opened, the film is right or the error is one of the device") {
  const render::Settings settings = settings_of("path");
  device::reopen_devices();
  no_faults();
  Outcome whole;
  whole.statistics = render::render(box(), settings, whole.film, {});
  int renders = 0, errors = 0;
  for (const std::string call :
       {"clCreateContext", "clCreateCommandQueue", "clCreateProgramWithSource", "clBuildProgram",
        "clCreateKernelsInProgram", "clCreateKernel", "clGetDeviceInfo", "clGetProgramInfo",
        "clGetProgramBuildInfo", "clGetKernelInfo", "clGetKernelArgInfo", "clGetPlatformInfo",
        "clCreateBuffer", "clEnqueueWriteBuffer"}) {
    device::reopen_devices();
    no_faults();
    Outcome without;
    without.statistics = render::render(box(), settings, without.film, {});
    const long count = faults::device_calls(call);
    for (const long first : std::set<long>{0, count / 2, count - 1}) {
      if (first < 0 || first >= count) continue;
      CAPTURE(call, count, first);
      device::reopen_devices();
      faults::plan_device_fault(call, first, 1, CL_OUT_OF_RESOURCES);
      Outcome outcome;
      try {
        outcome.statistics = render::render(box(), settings, outcome.film, {});
        ++renders;
        CHECK(same(outcome, whole));
      } catch (const DeviceError& error) {
        ++errors;
        CHECK_THAT(error.what(), !Catch::Contains("\n"));
      }
      CHECK(faults::device_faults() == 1);
      CHECK_FALSE(
          device::portable_lanes(device::open_devices({}).front())); // no compiler has refused anything
    }
  }
  no_faults();
  CHECK(renders > 0);
  CHECK(errors > 0);
}

TEST_CASE("a kept binary that cannot be loaded costs a build from the text") {
  const TemporaryFolder cache;
  const Environment folder("PHLUX_CACHE_DIR", cache.path().string());
  const Environment no_driver_cache("POCL_KERNEL_CACHE", "0"); // else PoCL keeps its programs itself
  const render::Settings settings = settings_of("path");
  const auto rendered = [&] {
    Outcome outcome;
    outcome.statistics = render::render(box(), settings, outcome.film, {});
    return outcome;
  };
  no_faults();
  const Outcome whole = rendered();
  CHECK_FALSE(whole.statistics.kernels_from_cache);
  const bool kept = rendered().statistics.kernels_from_cache; // some drivers have no binaries
  faults::plan_device_fault("clCreateProgramWithBinary", 0, 1, CL_OUT_OF_RESOURCES);
  const Outcome outcome = rendered();
  CHECK(faults::device_faults() == (kept ? 1 : 0));
  CHECK_FALSE(outcome.statistics.kernels_from_cache);
  CHECK(same(outcome, whole));
  no_faults();
  CHECK(rendered().statistics.kernels_from_cache == kept);
}

TEST_CASE("a device that cannot be divided is an error of the device") {
  render::Settings settings = settings_of("path");
  settings.threads = 1;
  const device::DeviceInfo device = device::chosen_devices({}).front();
  if (device.type != "cpu" || device.compute_units == 1) return;
  device::reopen_devices();
  faults::plan_device_fault("clCreateSubDevices", 0, 1, CL_OUT_OF_RESOURCES);
  film::Film film(width, height);
  CHECK_THROWS_MATCHES(render::render(box(), settings, film, {}), DeviceError,
                       Catch::Predicate<DeviceError>([](const DeviceError& error) {
                         return std::string(error.what())
                                    .find("cannot be divided (clCreateSubDevices: CL_OUT_OF_RESOURCES)") !=
                                std::string::npos;
                       }));
  CHECK_NOTHROW(render::render(box(), settings, film, {}));
  no_faults();
}

TEST_CASE("a failure while the tables of a scene are counted is an error of the device") {
  for (const char* call : {"clGetMemObjectInfo", "clCreateBuffer"}) {
    faults::plan_device_fault(call, 1, 1, CL_OUT_OF_RESOURCES);
    CHECK_THROWS_AS(render::outline(box(), settings_of("path")), DeviceError);
    CHECK(faults::device_faults() == 1);
  }
  no_faults();
  CHECK(render::outline(box(), settings_of("path")).table_bytes > 0);
}

TEST_CASE("where memory is short, launches get smaller until there is enough") {
  const std::string integrator = GENERATE("path", "bidir");
  render::Settings settings = settings_of(integrator, 256);
  settings.launch_seconds = 0.05;
  render::Renderer renderer(box(), settings, {});
  no_faults();
  const Outcome whole = render_by(renderer, settings);
  for (const char* call : {"clCreateBuffer", "clEnqueueNDRangeKernel"}) {
    CAPTURE(integrator, call);
    render::Renderer again(box(), settings, {});
    faults::plan_device_fault(call, 2, 3, CL_MEM_OBJECT_ALLOCATION_FAILURE);
    const Outcome outcome = render_by(again, settings);
    CHECK(faults::device_faults() == 3);
    CHECK_THAT(outcome.warnings.front(), Catch::Contains("with fewer work-items"));
    CHECK(same(outcome, whole));
  }
  no_faults();
}

TEST_CASE("an allocation that fails on the host costs no samples") {
  const std::string integrator = GENERATE("path", "bidir");
  const render::Settings settings = settings_of(integrator);
  render::Renderer renderer(box(), settings, {});
  const Outcome whole = render_by(renderer, settings);
  Outcome outcome;
  render::Events events = events_of(outcome);
  int launches = 0;
  events.progress = [&](const render::Progress&) {
    if (++launches == 1) throw std::bad_alloc();
    return true;
  };
  outcome.statistics = renderer.render(settings, outcome.film, events);
  CHECK(outcome.warnings.size() == 1);
  CHECK(same(outcome, whole));

  render::Renderer another(box(), settings, {});
  Outcome empty;
  allocations_left = 1; // the first large one
  const Outcome later = render_by(another, settings, std::move(empty));
  CHECK(allocations_left == 0);
  CHECK(same(later, whole));
}
