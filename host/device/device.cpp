#include "device/device.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "device/cache_folder.h"
#include "device/choice.h"
#include "errors.h"

namespace phlux::device {

namespace {

// Some drivers return names with blanks around them or with the terminating 0.
std::string trimmed(std::string text) {
  const auto blank = [](unsigned char c) { return c == '\0' || std::isspace(c) != 0; };
  while (!text.empty() && blank(static_cast<unsigned char>(text.back()))) text.pop_back();
  const auto first = std::find_if_not(text.begin(), text.end(), blank);
  return {first, text.end()};
}

std::string type_name(cl_device_type type) {
  if ((type & CL_DEVICE_TYPE_CPU) != 0) return "cpu";
  if ((type & CL_DEVICE_TYPE_GPU) != 0) return "gpu";
  return "accelerator";
}

// There is no WIDTH 2: masks cost what two lanes gain.
int lanes_of(const std::string& type, std::uint32_t native_float_width) {
  if (type != "cpu") return 1;
  for (int lanes : {16, 8, 4})
    if (native_float_width >= static_cast<std::uint32_t>(lanes)) return lanes;
  return 1;
}

DeviceInfo describe_device(const cl::Device& device, const std::string& platform, int platform_index,
                           int device_index) {
  DeviceInfo info;
  info.platform_index = platform_index;
  info.device_index = device_index;
  info.platform = platform;
  info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  info.type = type_name(device.getInfo<CL_DEVICE_TYPE>());
  info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
  info.opencl_c_version = trimmed(device.getInfo<CL_DEVICE_OPENCL_C_VERSION>());
  info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  info.global_memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.largest_buffer = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  info.native_float_width = device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>();
  info.doubles = device.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>() != 0;
  info.lanes = lanes_of(info.type, info.native_float_width);
  return info;
}

constexpr const char* what_to_install =
    "install a driver, such as the package pocl-opencl-icd for the CPU or the one of the GPU's vendor";

// All platforms and devices, enumerated once: a second time their order could differ, and warnings would be
// repeated.
struct Found {
  std::vector<PlatformInfo> platforms;
  std::vector<DeviceInfo> devices;
  std::vector<cl::Device> handles; // of the devices
  std::string failure;             // why there is no platform
};

// Without platforms, loaders return an empty list or fail with CL_PLATFORM_NOT_FOUND_KHR.
std::vector<cl::Platform> all_platforms(std::string& failure) {
  prepare_pocl_cache();
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error& error) {
    failure = fmt::format(" ({})", error_name(error.err()));
  }
  return platforms;
}

void add_platform(const cl::Platform& platform, Found& found) {
  PlatformInfo info;
  info.index = static_cast<int>(found.platforms.size());
  info.name = fmt::format("platform {}", info.index);
  try {
    info.name = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
    info.version = trimmed(platform.getInfo<CL_PLATFORM_VERSION>());
    std::vector<cl::Device> devices;
    platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    for (const cl::Device& device : devices) {
      found.devices.push_back(describe_device(device, info.name, info.index, info.devices));
      found.handles.push_back(device);
      ++info.devices;
    }
    if (devices.empty()) spdlog::debug("OpenCL platform {} ({}) has no devices", info.index, info.name);
  } catch (const cl::Error& error) {
    spdlog::warn("OpenCL platform {} ({}) has no devices that answer ({}): skipped", info.index, info.name,
                 describe(error));
  }
  found.platforms.push_back(info);
}

const Found& all_found() {
  static const Found& found = *[] {
    auto all = std::make_unique<Found>();
    for (const cl::Platform& platform : all_platforms(all->failure)) add_platform(platform, *all);
    return all.release(); // kept for the life of the process: PoCL crashes when it releases devices
  }();
  return found;
}

// "Clover and rusticl have no devices", or nothing.
std::string without_devices(const std::vector<PlatformInfo>& platforms) {
  std::vector<std::string> names;
  for (const PlatformInfo& each : platforms)
    if (each.devices == 0) names.push_back(each.name);
  if (names.empty()) return {};
  return fmt::format("{} {} no devices", fmt::join(names, " and "), names.size() == 1 ? "has" : "have");
}

const Found& some_found() {
  const Found& found = all_found();
  if (found.platforms.empty())
    throw DeviceError(fmt::format("no OpenCL platform{}: {}", found.failure, what_to_install));
  if (found.devices.empty())
    throw DeviceError(
        fmt::format("no OpenCL device: {}: {}", without_devices(found.platforms), what_to_install));
  return found;
}

Choice choice_of(const std::vector<std::string>& specifications, const Found& found) {
  std::vector<std::string> wanted = specifications;
  if (const char* preset = std::getenv("PHLUX_DEVICE");
      wanted.empty() && preset != nullptr && *preset != '\0')
    wanted.emplace_back(preset);
  try {
    return choose(wanted, found.devices);
  } catch (const DeviceError& error) {
    const std::string more = without_devices(found.platforms);
    throw DeviceError(more.empty() ? error.what() : fmt::format("{}; {}", error.what(), more));
  }
}

Device open(const DeviceInfo& info, const cl::Device& handle) {
  try {
    const cl::Context context(handle);
    return {info, handle, context, make_queue(context, handle)};
  } catch (const cl::Error& error) {
    throw DeviceError(fmt::format("OpenCL device {}:{} ({}) cannot be used: {}", info.platform_index,
                                  info.device_index, info.name, describe(error)));
  }
}

// A part of a CPU with so many threads. The part is never released, as all_found().
Device open_part(DeviceInfo info, cl::Device device, std::uint32_t threads) {
  const std::string wrong = fmt::format("`threads` {}: OpenCL device {}:{} ({})", threads,
                                        info.platform_index, info.device_index, info.name);
  if (info.type != "cpu") throw DeviceError(wrong + " is no CPU: leave it out, or name a CPU by `device`");
  if (threads > info.compute_units)
    throw DeviceError(fmt::format("{} has {}: give as many or fewer", wrong, info.compute_units));
  if (threads == info.compute_units) return open(info, device);
  const cl_device_partition_property by_counts[] = {CL_DEVICE_PARTITION_BY_COUNTS,
                                                    static_cast<cl_device_partition_property>(threads),
                                                    CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
  auto& part = *new std::vector<cl::Device>;
  try {
    device.createSubDevices(by_counts, &part);
  } catch (const cl::Error& error) {
    throw DeviceError(fmt::format("{} cannot be divided ({}): leave it out, or limit the process by taskset",
                                  wrong, describe(error)));
  }
  info.compute_units = threads;
  return open(info, part.front());
}

// By their places in all_found() and numbers of threads (0: all), and those that were forgotten. Never
// destroyed, as all_found().
struct Opened {
  std::mutex mutex;
  std::map<std::pair<std::size_t, int>, Device> devices;
  std::vector<decltype(devices)> forgotten;
};

Opened& opened() {
  static Opened& all = *new Opened;
  return all;
}

} // namespace

std::vector<PlatformInfo> list_platforms() {
  return all_found().platforms;
}

cl::CommandQueue make_queue(const cl::Context& context, const cl::Device& handle) {
  return {context, handle, CL_QUEUE_PROFILING_ENABLE};
}

std::vector<DeviceInfo> list_devices() {
  return some_found().devices;
}

std::vector<DeviceInfo> chosen_devices(const std::vector<std::string>& specifications) {
  const Found& found = some_found();
  std::vector<DeviceInfo> devices;
  for (const std::size_t i : choice_of(specifications, found).devices) devices.push_back(found.devices[i]);
  return devices;
}

std::vector<Device> open_devices(const std::vector<std::string>& specifications, std::optional<int> threads) {
  static std::set<std::string> told;
  Opened& all = opened();
  const std::lock_guard lock(all.mutex);
  const Found& found = some_found();
  const Choice choice = choice_of(specifications, found);
  for (const std::string& note : choice.notes)
    if (told.insert(note).second) spdlog::warn("{}", note);
  std::vector<Device> devices;
  for (const std::size_t i : choice.devices) {
    const DeviceInfo& info = found.devices[i];
    auto place = all.devices.find({i, threads.value_or(0)});
    if (place == all.devices.end())
      place = all.devices
                  .emplace(std::pair(i, threads.value_or(0)),
                           threads ? open_part(info, found.handles[i], static_cast<std::uint32_t>(*threads))
                                   : open(info, found.handles[i]))
                  .first;
    devices.push_back(place->second);
  }
  return devices;
}

void reopen_devices() {
  Opened& all = opened();
  const std::lock_guard lock(all.mutex);
  all.forgotten.push_back(std::exchange(all.devices, {}));
}

} // namespace phlux::device
