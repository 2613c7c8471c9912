#include "cli/version.h"

#include <fmt/format.h>

#include "commit.h" // written at every build, into the build folder
#include "device/device.h"

namespace phlux::cli {
namespace {

std::string line(const std::string& name, const std::string& value) {
  return fmt::format("\n{:<10} {}", name, value);
}

std::string platforms() {
  std::string lines;
  for (const device::PlatformInfo& each : device::list_platforms())
    lines += line(fmt::format("platform {}", each.index),
                  fmt::format("{}, {}, {} {}", each.name, each.version, each.devices,
                              each.devices == 1 ? "device" : "devices"));
  return lines.empty() ? line("platform", "none") : lines;
}

} // namespace

std::string version_report() {
  return "phlux " PHLUX_VERSION + line("commit", PHLUX_COMMIT) + line("compiler", PHLUX_COMPILER) +
         line("libraries", PHLUX_LIBRARIES) + line("OpenCL", device::icd_loader()) + platforms();
}

} // namespace phlux::cli
