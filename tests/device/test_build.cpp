#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "device/binary_cache.h"
#include "device/cache_folder.h"
#include "device/driver_cache.h"
#include "device/program.h"
#include "environment.h"
#include "errors.h"
#include "temporary_folder.h"

#include <unistd.h>

using namespace phlux;
using namespace phlux::device;
using Catch::Contains;
using Catch::StartsWith;

namespace {

const std::string twice_kernel = "__kernel void twice(__global float* x) {\n"
                                 "  x[get_global_id(0)] *= FACTOR;\n}\n";

Device test_device() {
  return open_devices({}).front();
}

ProgramSource twice() {
  return {"", {{"FACTOR", "2.0f"}}, {}, twice_kernel};
}

float run(const Device& device, const cl::Program& program, float x) {
  const cl::Buffer buffer(device.context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, sizeof x, &x);
  cl::Kernel kernel(program, "twice");
  kernel.setArg(0, buffer);
  device.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
  device.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, sizeof x, &x);
  return x;
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

} // namespace

TEST_CASE("a program is built once and then loaded") {
  const TemporaryFolder cache;
  const Environment variable("PHLUX_CACHE_DIR", cache.path().string());
  const Environment no_driver_cache("POCL_KERNEL_CACHE",
                                    "0"); // PoCL read it at its start; phlux reads it now
  const auto device = test_device();

  const auto first = build(device, sources::KernelFiles(), twice());
  CHECK_FALSE(first.from_cache);
  CHECK(run(device, first.program, 3.0f) == 6.0f);
  const auto second = build(device, sources::KernelFiles(), twice());
  CHECK(run(device, second.program, 3.0f) == 6.0f);
  REQUIRE(files_in(cache.path()).size() == 1);
  const auto file = files_in(cache.path()).front();
  CHECK(second.from_cache);

  SECTION("another define is another program") {
    auto source = twice();
    source.defines["FACTOR"] = "3.0f";
    const auto other = build(device, sources::KernelFiles(), source);
    CHECK_FALSE(other.from_cache);
    CHECK(run(device, other.program, 3.0f) == 9.0f);
  }
  SECTION("other options are another program") {
    const Environment options("PHLUX_KERNEL_OPTIONS", "-cl-opt-disable");
    CHECK_FALSE(build(device, sources::KernelFiles(), twice()).from_cache);
  }
  SECTION("a damaged file is replaced") {
    const auto good = TemporaryFolder::read(file);
    auto flipped = good;
    flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 1);
    for (const auto& bad :
         {std::string(), std::string("x"), good.substr(0, good.size() / 2), flipped, good + "x"}) {
      std::ofstream(file, std::ios::binary) << bad;
      const auto rebuilt = build(device, sources::KernelFiles(), twice());
      CHECK_FALSE(rebuilt.from_cache);
      CHECK(run(device, rebuilt.program, 3.0f) == 6.0f);
      CHECK(build(device, sources::KernelFiles(), twice()).from_cache);
    }
  }
  SECTION("a binary that the driver refuses is replaced") {
    const std::string nonsense(64, 'n');
    std::ofstream(file, std::ios::binary) << hash_of(nonsense) << nonsense;
    const auto rebuilt = build(device, sources::KernelFiles(), twice());
    CHECK_FALSE(rebuilt.from_cache);
    CHECK(run(device, rebuilt.program, 3.0f) == 6.0f);
    CHECK(build(device, sources::KernelFiles(), twice()).from_cache);
  }
}

TEST_CASE("PoCL keeps its programs itself") {
  const auto device = test_device();
  if (device.info.platform != "Portable Computing Language") return;
  const TemporaryFolder cache;
  const Environment variable("PHLUX_CACHE_DIR", cache.path().string());
  auto source = twice(); // a comment would not change the key
  source.defines["UNIQUE"] = std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
  CHECK_FALSE(build(device, sources::KernelFiles(), source).from_cache);
  const auto again = build(device, sources::KernelFiles(), source);
  CHECK(again.from_cache);
  CHECK(run(device, again.program, 3.0f) == 6.0f);
  CHECK(files_in(cache.path()).empty());
}

TEST_CASE("a record of the driver's cache names a folder of the driver, and nothing else") {
  const DriverRecord record{
      "phlux_0123456789abcdef", "OG/BFBDEJHLBJGBOHHC", {{"program.bc", "3 abc"}, {"k/1/k b.so", "4 d"}}};
  const auto back = DriverRecord::decode(record.encode());
  REQUIRE(back);
  CHECK(back->mark == record.mark);
  CHECK(back->folder == record.folder);
  CHECK(back->digests == record.digests);
  for (const std::string text : {"", "\n", "phlux_0123456789abcdef\n", "phlux_0123456789abcdef\n../../home\n",
                                 "phlux_0123456789abcdef\n/etc/passwdpasswd\n", "phlux_x\nOG/BFBDEJHLBJ\n",
                                 "phlux_0123456789abcdef\nOG/BFBDEJHLBJ\nprogram.bc\n"})
    CHECK_FALSE(DriverRecord::decode(text));
}

TEST_CASE("without a writable cache, programs are built") {
  const TemporaryFolder folder;
  folder.write("file", "");
  const Environment variable("PHLUX_CACHE_DIR", (folder.path() / "file" / "cache").string());
  const Environment no_driver_cache("POCL_KERNEL_CACHE", "0");
  const auto device = test_device();
  for (int time = 0; time < 2; ++time) {
    const auto built = build(device, sources::KernelFiles(), twice());
    CHECK_FALSE(built.from_cache);
    CHECK(run(device, built.program, 3.0f) == 6.0f);
  }
}

TEST_CASE("the cache stores and loads bytes") {
  const TemporaryFolder folder;
  const Environment variable("PHLUX_CACHE_DIR", (folder.path() / "made" / "here").string());
  const BinaryCache cache(binary_cache_folder());
  const std::vector<unsigned char> bytes{0, 1, 255, 10, 0};
  CHECK_FALSE(cache.load("key").has_value());
  cache.store("key", bytes);
  CHECK(cache.load("key") == bytes);
  CHECK_FALSE(cache.load("kez").has_value());
  cache.store("key", {7});
  CHECK(cache.load("key") == std::vector<unsigned char>{7});
  CHECK(files_in(folder.path() / "made" / "here").size() == 1);
}

TEST_CASE("128-bit FNV-1a") { // the empty string's is the offset basis; "a" by the definition
  CHECK(hash_of("") == "6c62272e07bb014262b821756295c58d");
  CHECK(hash_of("a") == "d228cb696f1a8caf78912b704e4a8964");
}

TEST_CASE("a folder is writable or not") {
  const TemporaryFolder folder;
  folder.write("file", "");
  CHECK(writable_folder(folder.path()));
  CHECK(writable_folder(folder.path() / "new" / "one"));
  CHECK_FALSE(writable_folder(folder.path() / "file"));
  CHECK_FALSE(writable_folder(folder.path() / "file" / "below"));
  CHECK(files_in(folder.path() / "new" / "one").empty());
  folder.write(fmt::format(".writable-{}", getpid()), ""); // left by a killed process of the same number
  CHECK(writable_folder(folder.path()));
  const auto temporary = temporary_cache_folder("test");
  REQUIRE(temporary.has_value());
  CHECK(writable_folder(*temporary));
}

TEST_CASE("a failed build names the kernel file and line") {
  const TemporaryFolder folder;
  folder.write("root.cl", "#include \"part.h\"\n");
  folder.write("part.h",
               "int right(int x);\nint right(int x) { return x; }\nint wrong(void) { return nowhere; }\n");
  const auto device = test_device();
  const sources::KernelFiles files(folder.path());
  CHECK_THROWS_AS(build(device, files, {"root.cl", {}, {}, ""}), DeviceError);
  CHECK_THROWS_WITH(build(device, files, {"root.cl", {}, {}, ""}),
                    StartsWith("part.h:3: ") && Contains("nowhere"));
  CHECK_THROWS_WITH(build(device, files, {"", {}, {}, "\n__kernel void f(void) { nowhere(); }\n"}),
                    StartsWith("extra:2: "));
}

TEST_CASE("a compiler that refuses the processor's own instructions gets portable lanes") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "lanes");
  folder.write("lanes/own.h", "#if !defined(LANES_PORTABLE) && !defined(__NO_COMPILER__)\n"
                              "static inline float own(float x) { return nowhere(x); }\n"
                              "#else\n"
                              "static inline float own(float x) { return 5 * x; }\n"
                              "#endif\n");
  folder.write("own.cl", "#ifndef LANES_PORTABLE\nint refused = nowhere;\n#endif\n");
  const sources::KernelFiles files(folder.path());
  const std::string kernel = "__kernel void twice(__global float* x) { x[0] = own(x[0]); }\n";
  const auto device = test_device();
  CHECK_THROWS_WITH(build(device, files, {"lanes/own.h", {}, {}, "__kernel void f(void) { wrong(); }\n"}),
                    StartsWith("extra:1: ") && Contains("wrong"));
  CHECK_THROWS_WITH(build(device, files, {"own.cl", {}, {}, ""}), StartsWith("own.cl:2: "));
  CHECK_FALSE(portable_lanes(device));
  CHECK(run(device, build(device, files, {"lanes/own.h", {}, {}, kernel}).program, 2.0f) == 10.0f);
  CHECK(portable_lanes(device));
  CHECK(run(device, build(device, files, {"lanes/own.h", {}, {}, kernel}).program, 3.0f) == 15.0f);
}

TEST_CASE("the first error of compilers' logs") {
  const std::string text =
      "#define A 1\n#line 1 \"path.cl\"\none\n#line 5 \"wide/lanes.h\"\nfive\nsix\n#line 2 \"path.cl\"\n";
  CHECK(first_error("2 warnings.\nwide/lanes.h:7:3: error: no such thing\n  here\n", text) ==
        "wide/lanes.h:7: no such thing"); // clang
  CHECK(first_error(
            "Device X failed to build the program\nerror: path.cl:12:9: use of undeclared identifier 'a'\n"
            "error: path.cl:13:9: another\n",
            text) == "path.cl:12: use of undeclared identifier 'a'"); // PoCL 3
  CHECK(first_error("path.cl:1:1: warning: odd\npath.cl:3:1: fatal error: gone\n", text) ==
        "path.cl:3: gone");
  CHECK(first_error("input.cl:6:1: error: bad\n", text) ==
        "wide/lanes.h:6: bad"); // oclgrind: lines of the whole text
  CHECK(first_error("input.cl:1:1: error: bad\n", text) == "defines:1: bad");
  CHECK(first_error("no place in here", text).empty());
  const std::string own =
      "#define OWN \"own.cl\"\n#line 1 \"own.cl\"\nint a;\n#line 1 \"my lobes/retro.cl\"\nint b;\n";
  CHECK(first_error("error: own.cl:1:5: bad\n", own) == "own.cl:1: bad");
  CHECK(first_error("error: my lobes/retro.cl:1:5: bad\n", own) == "my lobes/retro.cl:1: bad");
  CHECK(first_error("my lobes/retro.cl:1:5: error: bad\n", own) == "my lobes/retro.cl:1: bad");
}

TEST_CASE("slow is called when building takes long, and only then", "[slow]") {
  const TemporaryFolder cache;
  const Environment variable("PHLUX_CACHE_DIR", cache.path().string());
  const auto device = test_device();
  const std::string now = std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
  std::atomic<int> calls = 0;
  const auto seconds_for = [&](int kernels) {
    std::string text;
    for (int i = 0; i < kernels; ++i)
      text += "__kernel void k" + std::to_string(i) +
              "(__global float16* x) { x[get_global_id(0)] = pow(x[1], x[2]); }\n";
    calls = 0;
    return build(device, sources::KernelFiles(), {"", {{"UNIQUE", now}}, {}, text}, [&] { ++calls; }).seconds;
  };
  // The callback is due after 0.2 s; near that, or on a busy machine, either result is valid.
  constexpr double quick = 0.1, slow = 0.6;
  (void)seconds_for(1);
  if (seconds_for(1) < quick) CHECK(calls == 0); // from the cache
  double seconds = 0;
  for (int kernels = 32; seconds < slow; kernels *= 2) seconds = seconds_for(kernels);
  CHECK(calls == 1);
}

TEST_CASE("options for every program") {
  CHECK_THAT(build_options(), StartsWith("-cl-std=CL1.2 ") && Contains("-cl-denorms-are-zero"));
  CHECK_THAT(build_options(), !Contains("fast"));
  const Environment more("PHLUX_KERNEL_OPTIONS", "-Werror");
  CHECK_THAT(build_options(), Contains(" -Werror"));
  if (test_device().info.platform == "Portable Computing Language") // other compilers may reject the option
    CHECK_THROWS_AS(
        build(test_device(), sources::KernelFiles(), {"", {}, {}, "__kernel void f(void) { int x; x; }\n"}),
        DeviceError);
}
