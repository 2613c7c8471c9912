// clGetExtensionFunctionAddress, deprecated in OpenCL 1.2, is the only query that needs no platform.
#define CL_USE_DEPRECATED_OPENCL_1_1_APIS
#include <fmt/format.h>

#include "device/device.h"

namespace phlux::device {

std::string icd_loader() {
  using Query = cl_int (*)(cl_uint name, std::size_t size, void* value, std::size_t* size_needed);
  constexpr cl_uint version = 2, name = 3; // CL_ICDL_VERSION, CL_ICDL_NAME
  const auto query = reinterpret_cast<Query>(clGetExtensionFunctionAddress("clGetICDLoaderInfoOCLICD"));
  if (query == nullptr) return "a loader of unknown name";
  const auto text_of = [&](cl_uint what) {
    std::string text(256, '\0');
    return std::string(query(what, text.size() - 1, text.data(), nullptr) == CL_SUCCESS ? text.c_str()
                                                                                        : "unknown");
  };
  return fmt::format("{} {}", text_of(name), text_of(version));
}

} // namespace phlux::device
