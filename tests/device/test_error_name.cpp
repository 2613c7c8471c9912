#include <catch2/catch.hpp>

#include <set>

#include "device/opencl.h"

using phlux::device::describe;
using phlux::device::error_name;

TEST_CASE("every error code of OpenCL 1.2 has its own name") {
  std::set<std::string> names;
  for (cl_int code = 0; code >= -19; --code) names.insert(error_name(code));
  for (cl_int code = -30; code >= -68; --code) names.insert(error_name(code));
  CHECK(names.size() == 20 + 39);
  for (const auto& name : names) CHECK(name.rfind("CL_", 0) == 0);
}

TEST_CASE("error codes by name") {
  CHECK(error_name(0) == "CL_SUCCESS");
  CHECK(error_name(-5) == "CL_OUT_OF_RESOURCES");
  CHECK(error_name(-11) == "CL_BUILD_PROGRAM_FAILURE");
  CHECK(error_name(-61) == "CL_INVALID_BUFFER_SIZE");
  CHECK(error_name(-1001) == "CL_PLATFORM_NOT_FOUND_KHR");
  CHECK(error_name(-9999) == "OpenCL error -9999");
  CHECK(describe(cl::Error(-5, "clFinish")) == "clFinish: CL_OUT_OF_RESOURCES");
}
