// Compiles the example of the Phong module on the first CPU; prints what fails.
#define CL_TARGET_OPENCL_VERSION 120
#include <cstdio>
#include <string>

#include <CL/cl.h>

int main() {
  cl_platform_id platform = nullptr;
  cl_device_id device = nullptr;
  if (clGetPlatformIDs(1, &platform, nullptr) != CL_SUCCESS ||
      clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, nullptr) != CL_SUCCESS) {
    std::puts("skipped: no OpenCL device");
    return 77;
  }
  const cl_context context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, nullptr);
  const char* source = "#define WIDTH 1\n"
                       "#define PHONG_STRATEGY \"phong/strategies/exact.cl\"\n"
                       "#include \"phong/example.cl\"\n";
  const cl_program program = clCreateProgramWithSource(context, 1, &source, nullptr, nullptr);
  const std::string options = "-I " PHLUX_KERNELS;
  cl_int error = clBuildProgram(program, 1, &device, options.c_str(), nullptr, nullptr);
  if (error == CL_SUCCESS) static_cast<void>(clCreateKernel(program, "mean_weight", &error));
  std::printf("%s: %d\n", PHLUX_KERNELS, error);
  return error == CL_SUCCESS ? 0 : 1;
}
