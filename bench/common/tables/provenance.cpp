#include "bench/common/tables/provenance.h"

#include <chrono>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "files/json.h"
#include "files/output.h"

namespace phlux::bench {

void write_provenance(const std::filesystem::path& folder, const std::string& name,
                      const Provenance& provenance) {
  const device::DeviceInfo& device = provenance.device;
  const nlohmann::ordered_json json = {
      {"command", provenance.command},
      {"device", device.name},
      {"platform", device.platform},
      {"driver", device.driver},
      {"OpenCL C", device.opencl_c_version},
      {"compute units", device.compute_units},
      {"WIDTH", provenance.lanes},
      {"kernel cache", provenance.kernel_cache},
      {"seeds", provenance.seeds},
      {"phlux", PHLUX_VERSION},
      {"compiler", __VERSION__},
      {"date", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)))},
  };
  files::write_file(folder / (name + ".provenance.json"), files::json_text(json));
}

} // namespace phlux::bench
