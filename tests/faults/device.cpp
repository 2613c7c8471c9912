#include "faults/device.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <mutex>
#include <sstream>
#include <vector>

#include <dlfcn.h>
#include <pthread.h>

#define CL_TARGET_OPENCL_VERSION 120
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS
#include <CL/cl.h>

namespace faults {
namespace {

class Plan {
public:
  Plan() {
    const char* text = std::getenv("PHLUX_DEVICE_FAULT");
    if (text == nullptr) return;
    std::istringstream words(text);
    words >> call_ >> first_ >> count_ >> code_;
    if (!(words >> queue_)) queue_ = -1;
  }
  void set(const std::string& call, long first, long count, int code, int queue) {
    const std::lock_guard lock(mutex_);
    call_ = call;
    first_ = first;
    count_ = count;
    code_ = code;
    queue_ = queue;
    struck_ = 0;
    calls_.clear();
  }
  // The error that a call is to return; CL_SUCCESS: none.
  cl_int error_of(const std::string& call, cl_command_queue queue = nullptr) {
    const std::lock_guard lock(mutex_);
    if (queue != nullptr && std::ranges::find(queues_, queue) == queues_.end()) queues_.push_back(queue);
    if (queue_ >= 0 && (queue == nullptr || std::ranges::find(queues_, queue) - queues_.begin() != queue_))
      return CL_SUCCESS;
    const long number = calls_[call]++;
    if (call != call_ || number < first_ || number - first_ >= count_) return CL_SUCCESS;
    ++struck_;
    return code_;
  }
  // Whether a call that returns an object is to fail; then it writes the error.
  bool fails(const std::string& call, cl_int* error, cl_command_queue queue = nullptr) {
    const cl_int code = error_of(call, queue);
    if (code != CL_SUCCESS && error != nullptr) *error = code;
    return code != CL_SUCCESS;
  }
  long calls(const std::string& call) {
    const std::lock_guard lock(mutex_);
    return calls_[call];
  }
  long struck() {
    const std::lock_guard lock(mutex_);
    return struck_;
  }

private:
  std::mutex mutex_;
  std::string call_;
  long first_ = 0, count_ = 0, struck_ = 0;
  int code_ = 0, queue_ = -1;
  std::map<std::string, long> calls_;
  std::vector<cl_command_queue> queues_;
};

// Never destroyed: drivers make calls while the process ends.
Plan& plan() {
  static Plan& only = *new Plan;
  return only;
}

std::mutex mapped_mutex;
long mapped = 0;

void count_mapped(long change) {
  const std::lock_guard lock(mapped_mutex);
  mapped += change;
}

template<class Function>
Function* loader(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

} // namespace

void plan_device_fault(const std::string& call, long first, long count, int code, int queue) {
  plan().set(call, first, count, code, queue);
}

long device_calls(const std::string& call) {
  return plan().calls(call);
}

long device_faults() {
  return plan().struck();
}

long mapped_buffers() {
  const std::lock_guard lock(mapped_mutex);
  return mapped;
}

} // namespace faults

using faults::loader;
using faults::plan;

// A function that returns its error, and one that returns an object and writes the error to its last
// parameter.
#define RETURNS_ERROR(name, queue, parameters, arguments)                                                    \
  extern "C" cl_int name parameters {                                                                        \
    static auto* const driver = loader<cl_int parameters>(#name);                                            \
    if (const cl_int error = plan().error_of(#name, queue); error != CL_SUCCESS) return error;               \
    return driver arguments;                                                                                 \
  }
#define RETURNS_OBJECT(type, name, parameters, arguments)                                                    \
  extern "C" type name parameters {                                                                          \
    static auto* const driver = loader<type parameters>(#name);                                              \
    if (plan().fails(#name, error)) return nullptr;                                                          \
    return driver arguments;                                                                                 \
  }

RETURNS_ERROR(clEnqueueNDRangeKernel, queue,
              (cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
               const size_t* size, const size_t* local, cl_uint count, const cl_event* events,
               cl_event* event),
              (queue, kernel, dimensions, offset, size, local, count, events, event))
RETURNS_ERROR(clEnqueueReadBuffer, queue,
              (cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset, size_t bytes, void* to,
               cl_uint count, const cl_event* events, cl_event* event),
              (queue, buffer, blocking, offset, bytes, to, count, events, event))
RETURNS_ERROR(clWaitForEvents, nullptr, (cl_uint count, const cl_event* events), (count, events))
RETURNS_ERROR(clGetEventInfo, nullptr,
              (cl_event event, cl_event_info what, size_t bytes, void* to, size_t* needed),
              (event, what, bytes, to, needed))
RETURNS_ERROR(clGetEventProfilingInfo, nullptr,
              (cl_event event, cl_profiling_info what, size_t bytes, void* to, size_t* needed),
              (event, what, bytes, to, needed))
RETURNS_ERROR(clSetKernelArg, nullptr, (cl_kernel kernel, cl_uint index, size_t bytes, const void* value),
              (kernel, index, bytes, value))
RETURNS_ERROR(clEnqueueWriteBuffer, queue,
              (cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset, size_t bytes,
               const void* from, cl_uint count, const cl_event* events, cl_event* event),
              (queue, buffer, blocking, offset, bytes, from, count, events, event))
RETURNS_ERROR(clBuildProgram, nullptr,
              (cl_program program, cl_uint count, const cl_device_id* devices, const char* options,
               void(CL_CALLBACK* notify)(cl_program, void*), void* data),
              (program, count, devices, options, notify, data))
RETURNS_ERROR(clCreateKernelsInProgram, nullptr,
              (cl_program program, cl_uint count, cl_kernel* kernels, cl_uint* created),
              (program, count, kernels, created))
RETURNS_ERROR(clGetDeviceInfo, nullptr,
              (cl_device_id device, cl_device_info what, size_t bytes, void* to, size_t* needed),
              (device, what, bytes, to, needed))
RETURNS_ERROR(clGetProgramInfo, nullptr,
              (cl_program program, cl_program_info what, size_t bytes, void* to, size_t* needed),
              (program, what, bytes, to, needed))
RETURNS_ERROR(clGetProgramBuildInfo, nullptr,
              (cl_program program, cl_device_id device, cl_program_build_info what, size_t bytes, void* to,
               size_t* needed),
              (program, device, what, bytes, to, needed))
RETURNS_ERROR(clGetKernelInfo, nullptr,
              (cl_kernel kernel, cl_kernel_info what, size_t bytes, void* to, size_t* needed),
              (kernel, what, bytes, to, needed))
RETURNS_ERROR(clGetKernelArgInfo, nullptr,
              (cl_kernel kernel, cl_uint index, cl_kernel_arg_info what, size_t bytes, void* to,
               size_t* needed),
              (kernel, index, what, bytes, to, needed))
RETURNS_ERROR(clGetMemObjectInfo, nullptr,
              (cl_mem buffer, cl_mem_info what, size_t bytes, void* to, size_t* needed),
              (buffer, what, bytes, to, needed))
RETURNS_ERROR(clGetPlatformIDs, nullptr, (cl_uint count, cl_platform_id* platforms, cl_uint* found),
              (count, platforms, found))
RETURNS_ERROR(clGetPlatformInfo, nullptr,
              (cl_platform_id platform, cl_platform_info what, size_t bytes, void* to, size_t* needed),
              (platform, what, bytes, to, needed))
RETURNS_ERROR(clGetDeviceIDs, nullptr,
              (cl_platform_id platform, cl_device_type type, cl_uint count, cl_device_id* devices,
               cl_uint* found),
              (platform, type, count, devices, found))
RETURNS_ERROR(clCreateSubDevices, nullptr,
              (cl_device_id device, const cl_device_partition_property* properties, cl_uint count,
               cl_device_id* parts, cl_uint* created),
              (device, properties, count, parts, created))
RETURNS_ERROR(clFlush, queue, (cl_command_queue queue), (queue))
RETURNS_ERROR(clFinish, queue, (cl_command_queue queue), (queue))
RETURNS_OBJECT(cl_mem, clCreateBuffer,
               (cl_context context, cl_mem_flags flags, size_t bytes, void* host, cl_int* error),
               (context, flags, bytes, host, error))
RETURNS_OBJECT(cl_context, clCreateContext,
               (const cl_context_properties* properties, cl_uint count, const cl_device_id* devices,
                void(CL_CALLBACK* notify)(const char*, const void*, size_t, void*), void* data,
                cl_int* error),
               (properties, count, devices, notify, data, error))
RETURNS_OBJECT(cl_command_queue, clCreateCommandQueue,
               (cl_context context, cl_device_id device, cl_command_queue_properties properties,
                cl_int* error),
               (context, device, properties, error))
RETURNS_OBJECT(cl_program, clCreateProgramWithSource,
               (cl_context context, cl_uint count, const char** texts, const size_t* lengths, cl_int* error),
               (context, count, texts, lengths, error))
RETURNS_OBJECT(cl_program, clCreateProgramWithBinary,
               (cl_context context, cl_uint count, const cl_device_id* devices, const size_t* lengths,
                const unsigned char** binaries, cl_int* status, cl_int* error),
               (context, count, devices, lengths, binaries, status, error))
RETURNS_OBJECT(cl_kernel, clCreateKernel, (cl_program program, const char* name, cl_int* error),
               (program, name, error))

extern "C" void* clEnqueueMapBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking,
                                    cl_map_flags flags, size_t offset, size_t bytes, cl_uint count,
                                    const cl_event* events, cl_event* event, cl_int* error) {
  static auto* const driver = loader<decltype(clEnqueueMapBuffer)>("clEnqueueMapBuffer");
  if (plan().fails("clEnqueueMapBuffer", error, queue)) return nullptr;
  void* const memory = driver(queue, buffer, blocking, flags, offset, bytes, count, events, event, error);
  if (memory != nullptr) faults::count_mapped(1);
  return memory;
}

extern "C" cl_int clEnqueueUnmapMemObject(cl_command_queue queue, cl_mem buffer, void* memory, cl_uint count,
                                          const cl_event* events, cl_event* event) {
  static auto* const driver = loader<decltype(clEnqueueUnmapMemObject)>("clEnqueueUnmapMemObject");
  if (const cl_int error = plan().error_of("clEnqueueUnmapMemObject", queue); error != CL_SUCCESS)
    return error;
  const cl_int result = driver(queue, buffer, memory, count, events, event);
  if (result == CL_SUCCESS) faults::count_mapped(-1);
  return result;
}

// Only calls of the C++ library count: those of a driver are its own affair.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*function)(void*),
                              void* argument) noexcept {
  static auto* const real =
      loader<int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create");
  Dl_info caller;
  const bool counts = ::dladdr(__builtin_return_address(0), &caller) != 0 &&
                      std::string(caller.dli_fname).find("libstdc++") != std::string::npos;
  if (const int error = counts ? plan().error_of("pthread_create") : 0; error != 0) return error;
  return real(thread, attributes, function, argument);
}
