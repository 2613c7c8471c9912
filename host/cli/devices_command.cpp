#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/table.h"
#include "device/device.h"
#include "errors.h"
#include "files/json.h"
#include "terminal.h"

namespace phlux::cli {
namespace {

std::string specification(const device::DeviceInfo& info) {
  return fmt::format("{}:{}", info.platform_index, info.device_index);
}

// The devices of a render without --device; none when they cannot be opened or PHLUX_DEVICE matches none.
std::vector<std::string> default_specifications() {
  std::vector<std::string> specifications;
  try {
    for (const device::Device& device : device::open_devices({}))
      specifications.push_back(specification(device.info));
  } catch (const DeviceError&) {
  }
  return specifications;
}

nlohmann::ordered_json to_json(const device::DeviceInfo& info, bool is_default) {
  return {{"device", specification(info)},
          {"platform", info.platform},
          {"type", info.type},
          {"name", info.name},
          {"driver", info.driver},
          {"opencl_c_version", info.opencl_c_version},
          {"compute_units", info.compute_units},
          {"global_memory", info.global_memory},
          {"largest_buffer", info.largest_buffer},
          {"native_float_width", info.native_float_width},
          {"doubles", info.doubles},
          {"width", info.lanes},
          {"default", is_default}};
}

std::string gibibytes(std::uint64_t bytes) {
  return fmt::format("{:.1f} GiB", static_cast<double>(bytes) * 0x1p-30);
}

using Row = std::vector<std::string>;
const Row headings = {"DEVICE", "TYPE",   "NAME",           "PLATFORM",     "DRIVER", "OPENCL C",
                      "UNITS",  "MEMORY", "LARGEST BUFFER", "NATIVE WIDTH", "WIDTH"};

Row to_row(const device::DeviceInfo& info, bool is_default) {
  return {specification(info) + (is_default ? " *" : ""),
          info.type,
          info.name,
          info.platform,
          info.driver,
          info.opencl_c_version,
          fmt::format("{}", info.compute_units),
          gibibytes(info.global_memory),
          gibibytes(info.largest_buffer),
          fmt::format("{}", info.native_float_width),
          fmt::format("{}", info.lanes)};
}

} // namespace

int list_devices(const DevicesOptions& options) {
  const std::vector<device::DeviceInfo> devices = device::list_devices();
  const std::vector<std::string> defaults = default_specifications();
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::vector<Row> rows = {headings};
  for (const device::DeviceInfo& info : devices) {
    const bool is_default = std::ranges::find(defaults, specification(info)) != defaults.end();
    json.push_back(to_json(info, is_default));
    rows.push_back(to_row(info, is_default));
  }
  if (options.json) {
    say("{}", files::json_text(json));
  } else {
    print_table(rows);
    say("* used unless --device says otherwise; WIDTH: paths that one work item traces at a time\n");
    for (const device::PlatformInfo& platform : device::list_platforms())
      if (platform.devices == 0) say("platform {}, {}, has no devices\n", platform.index, platform.name);
  }
  return 0;
}

} // namespace phlux::cli
