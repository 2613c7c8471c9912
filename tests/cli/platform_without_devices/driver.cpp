// An OpenCL driver whose platform has no devices, like a GPU driver on a machine without that GPU. The loader
// finds it through an .icd file in the folder OCL_ICD_VENDORS.
#include <cstring>
#include <string>

#include <CL/cl.h>
#include <CL/cl_icd.h>

// The loader expects the table of calls in the first member of each handle.
struct _cl_platform_id {
  const cl_icd_dispatch* dispatch;
};

namespace {

constexpr cl_uint icd_suffix = 0x0920; // CL_PLATFORM_ICD_SUFFIX_KHR

cl_int CL_API_CALL platform_info(cl_platform_id, cl_platform_info name, std::size_t size, void* value,
                                 std::size_t* size_needed) {
  std::string text;
  switch (name) {
  case CL_PLATFORM_NAME:
    text = "Driver of nothing";
    break;
  case CL_PLATFORM_VERSION:
    text = "OpenCL 1.2 nothing";
    break;
  case CL_PLATFORM_VENDOR:
    text = "nobody";
    break;
  case CL_PLATFORM_PROFILE:
    text = "FULL_PROFILE";
    break;
  case CL_PLATFORM_EXTENSIONS:
    text = "cl_khr_icd";
    break;
  case icd_suffix:
    text = "NIL";
    break;
  default:
    return CL_INVALID_VALUE;
  }
  if (size_needed != nullptr) *size_needed = text.size() + 1;
  if (value == nullptr) return CL_SUCCESS;
  if (size < text.size() + 1) return CL_INVALID_VALUE;
  std::memcpy(value, text.c_str(), text.size() + 1);
  return CL_SUCCESS;
}

cl_int CL_API_CALL device_ids(cl_platform_id, cl_device_type, cl_uint, cl_device_id*, cl_uint* count) {
  if (count != nullptr) *count = 0;
  return CL_DEVICE_NOT_FOUND;
}

const cl_icd_dispatch& calls() {
  static const cl_icd_dispatch table = [] {
    cl_icd_dispatch made{};
    made.clGetPlatformInfo = platform_info;
    made.clGetDeviceIDs = device_ids;
    return made;
  }();
  return table;
}

cl_int CL_API_CALL platform_ids(cl_uint room, cl_platform_id* platforms, cl_uint* count) {
  static _cl_platform_id platform{&calls()};
  if (count != nullptr) *count = 1;
  if (platforms != nullptr && room > 0) *platforms = &platform;
  return CL_SUCCESS;
}

} // namespace

extern "C" {

// Newer loaders get these functions by this call; older ones look them up by symbol.
CL_API_ENTRY void* CL_API_CALL clGetExtensionFunctionAddress(const char* name) {
  if (std::strcmp(name, "clIcdGetPlatformIDsKHR") == 0) return reinterpret_cast<void*>(platform_ids);
  if (std::strcmp(name, "clGetPlatformInfo") == 0) return reinterpret_cast<void*>(platform_info);
  return nullptr;
}

CL_API_ENTRY cl_int CL_API_CALL clIcdGetPlatformIDsKHR(cl_uint room, cl_platform_id* platforms,
                                                       cl_uint* count) {
  return platform_ids(room, platforms, count);
}
}
