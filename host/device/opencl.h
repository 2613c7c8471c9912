// Includes the OpenCL C++ bindings, with one configuration for all files.
#pragma once

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wignored-attributes"
#include <CL/opencl.hpp>
#pragma GCC diagnostic pop

#include <string>

namespace phlux::device {

/// "CL_OUT_OF_RESOURCES" for -5 and so on; "OpenCL error N" for an unknown code.
[[nodiscard]] std::string error_name(cl_int code);

/// The call that failed and the code's name: "clEnqueueNDRangeKernel: CL_OUT_OF_RESOURCES".
[[nodiscard]] std::string describe(const cl::Error& error);

} // namespace phlux::device
