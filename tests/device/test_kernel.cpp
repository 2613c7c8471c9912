// Setting kernel arguments by name.
#include "device/kernel.h"

#include <catch2/catch.hpp>

#include "environment.h"
#include "errors.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::device;
using Catch::Contains;

namespace {

const std::string text = "#define PAIR float first, float second\n"
                         "__kernel void weigh(PAIR, __global float* results) {\n"
                         "  results[get_global_id(0)] = first + 10 * second;\n"
                         "}\n"
                         "__kernel void nothing(void) {}\n";

const ArgumentNames names = {{"weigh", {"first", "second", "results"}}, {"nothing", {}}};

Device test_device() {
  return open_devices({}).front();
}

float weigh(const Device& device, const BuiltProgram& program) {
  const cl::Buffer results(device.context, CL_MEM_WRITE_ONLY, sizeof(float));
  Kernel kernel(program, "weigh");
  kernel.set("results", results);
  kernel.set("second", 2.0F);
  kernel.set("third", 5.0F); // not an argument
  CHECK(kernel.first_unset() == 0);
  CHECK_THROWS_AS(kernel.ready(), DeviceError);
  CHECK_THROWS_WITH(kernel.ready(), "kernel weigh: nothing sets its argument first: set each argument before "
                                    "it runs");
  kernel.set(0, 1.0F);
  CHECK(kernel.first_unset() == 3);
  float result = 0;
  device.queue.enqueueNDRangeKernel(kernel.ready(), cl::NullRange, cl::NDRange(1), cl::NDRange(1));
  device.queue.enqueueReadBuffer(results, CL_TRUE, 0, sizeof result, &result);
  return result;
}

} // namespace

TEST_CASE("arguments are set by their names; those that a kernel lacks are passed over") {
  const Device device = test_device();
  const BuiltProgram program = build(device, sources::KernelFiles(), {"", {}, {}, text});
  CHECK(program.arguments == names);
  CHECK(weigh(device, program) == 21.0F);
  CHECK_NOTHROW(Kernel(program, "nothing").ready());
}

TEST_CASE("a program from the cache knows the names though its driver need not") {
  const TemporaryFolder cache;
  const Environment variable("PHLUX_CACHE_DIR", cache.path().string());
  const Environment no_driver_cache("POCL_KERNEL_CACHE", "0");
  const Device device = test_device();
  (void)build(device, sources::KernelFiles(), {"", {}, {}, text});
  const BuiltProgram loaded = build(device, sources::KernelFiles(), {"", {}, {}, text});
  CHECK(loaded.from_cache);
  CHECK(loaded.arguments == names);
  CHECK(weigh(device, loaded) == 21.0F);
}

TEST_CASE("what cannot be set or run is named") {
  const BuiltProgram program = build(test_device(), sources::KernelFiles(), {"", {}, {}, text});
  CHECK_THROWS_WITH(Kernel(program, "wiegh"),
                    Contains("kernel wiegh: ") && Contains("CL_INVALID_KERNEL_NAME"));
  Kernel kernel(program, "weigh");
  CHECK_THROWS_WITH(kernel.set("first", cl_float8{}),
                    Contains("kernel weigh, argument first: ") && Contains("CL_INVALID_ARG_SIZE"));
  CHECK_THROWS_WITH(kernel.ready(), Contains("arguments first, second, results"));
  BuiltProgram nameless = program;
  nameless.arguments.clear();
  CHECK_THROWS_WITH(Kernel(nameless, "weigh"), Contains("does not say what its arguments are called"));
}

TEST_CASE("a binary and the names come back from what is kept") {
  const NamedBinary named{names, {7, 0, 255, '\n', 0}};
  const NamedBinary back = decode(encode(named));
  CHECK(back.arguments == named.arguments);
  CHECK(back.binary == named.binary);
  CHECK(decode({'x'}).binary.empty());
  CHECK(decode({}).arguments.empty());
}
