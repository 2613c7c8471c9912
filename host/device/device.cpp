#include "device/device.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <mutex>
#include <optional>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "device/cache_folder.h"
#include "errors.h"

namespace phlux::device {

namespace {

struct Found {
  DeviceInfo info;
  cl::Device handle;
};

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Drivers return names with blanks around them, and some with the terminating zero inside.
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

// WIDTH 2 does not exist: what is gained by two lanes is lost to the masks.
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

std::vector<cl::Platform> all_platforms() {
  prepare_pocl_cache();
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error& error) {
    throw DeviceError(fmt::format("no OpenCL platform ({}): {}", error_name(error.err()), what_to_install));
  }
  if (platforms.empty()) throw DeviceError(fmt::format("no OpenCL platform: {}", what_to_install));
  return platforms;
}

void add_devices(const cl::Platform& platform, int platform_index, std::vector<Found>& found) {
  std::string name = fmt::format("platform {}", platform_index);
  try {
    name = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
    std::vector<cl::Device> devices;
    platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    if (devices.empty())
      spdlog::warn("OpenCL platform {} ({}) has no devices: skipped", platform_index, name);
    for (std::size_t i = 0; i < devices.size(); ++i)
      found.push_back({describe_device(devices[i], name, platform_index, static_cast<int>(i)), devices[i]});
  } catch (const cl::Error& error) {
    spdlog::warn("OpenCL platform {} ({}) has no devices that answer ({}): skipped", platform_index, name,
                 describe(error));
  }
}

// Found once: a second question could number the devices differently, and a warning should not come twice.
const std::vector<Found>& all_devices() {
  static const std::vector<Found>& found = *[] {
    auto devices = std::make_unique<std::vector<Found>>();
    const auto platforms = all_platforms();
    for (std::size_t i = 0; i < platforms.size(); ++i)
      add_devices(platforms[i], static_cast<int>(i), *devices);
    if (devices->empty()) throw DeviceError(fmt::format("no OpenCL device: {}", what_to_install));
    return devices.release(); // kept for the life of the process: PoCL crashes when it releases devices
  }();
  return found;
}

std::optional<std::pair<int, int>> parse_indices(const std::string& specification) {
  const auto colon = specification.find(':');
  const auto is_number = [](const std::string& text) {
    return !text.empty() && text.size() <= 6 &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  if (colon == std::string::npos) return std::nullopt;
  const std::string platform = specification.substr(0, colon), device = specification.substr(colon + 1);
  if (!is_number(platform) || !is_number(device)) return std::nullopt;
  return std::pair{std::stoi(platform), std::stoi(device)};
}

bool names(const std::string& specification, const DeviceInfo& info) {
  const std::string wanted = lower_case(specification);
  if (wanted.empty()) return false;
  if (wanted == "all") return true;
  if (wanted == "cpu" || wanted == "gpu") return info.type == wanted;
  if (const auto indices = parse_indices(wanted))
    return *indices == std::pair{info.platform_index, info.device_index};
  return lower_case(info.name).find(wanted) != std::string::npos ||
         lower_case(info.platform).find(wanted) != std::string::npos;
}

std::string listing(const std::vector<Found>& found) {
  std::string list;
  for (const auto& [info, handle] : found)
    list += fmt::format("{}{}:{} ({}) {}, {}", list.empty() ? "" : "; ", info.platform_index,
                        info.device_index, info.type, info.name, info.platform);
  return list;
}

std::size_t default_device(const std::vector<Found>& found) {
  const auto cpu =
      std::find_if(found.begin(), found.end(), [](const Found& each) { return each.info.type == "cpu"; });
  return cpu == found.end() ? 0 : static_cast<std::size_t>(cpu - found.begin());
}

std::vector<std::size_t> chosen(const std::vector<std::string>& specifications,
                                const std::vector<Found>& found) {
  std::vector<std::size_t> indices;
  for (const auto& specification : specifications) {
    bool any = false;
    for (std::size_t i = 0; i < found.size(); ++i)
      if (names(specification, found[i].info)) {
        if (std::find(indices.begin(), indices.end(), i) == indices.end()) indices.push_back(i);
        any = true;
      }
    if (!any)
      throw DeviceError(fmt::format("no OpenCL device '{}': there is {}", specification, listing(found)));
  }
  if (indices.empty()) indices.push_back(default_device(found));
  return indices;
}

Device open(const Found& found) {
  try {
    const cl::Context context(found.handle);
    const cl::CommandQueue queue(context, found.handle, CL_QUEUE_PROFILING_ENABLE);
    return {found.info, found.handle, context, queue};
  } catch (const cl::Error& error) {
    throw DeviceError(fmt::format("OpenCL device {}:{} ({}) cannot be used: {}", found.info.platform_index,
                                  found.info.device_index, found.info.name, describe(error)));
  }
}

} // namespace

std::vector<DeviceInfo> list_devices() {
  std::vector<DeviceInfo> infos;
  for (const auto& each : all_devices()) infos.push_back(each.info);
  return infos;
}

std::vector<Device> open_devices(const std::vector<std::string>& specifications) {
  std::vector<std::string> wanted = specifications;
  if (const char* preset = std::getenv("PHLUX_DEVICE");
      wanted.empty() && preset != nullptr && *preset != '\0')
    wanted.emplace_back(preset);

  static std::mutex mutex;
  static auto& opened = *new std::vector<std::optional<Device>>; // never destroyed, as above
  const std::lock_guard lock(mutex);
  const auto& found = all_devices();
  opened.resize(found.size());
  std::vector<Device> devices;
  for (const std::size_t i : chosen(wanted, found)) {
    if (!opened[i]) opened[i] = open(found[i]);
    devices.push_back(*opened[i]);
  }
  return devices;
}

} // namespace phlux::device
