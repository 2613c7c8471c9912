// Choice of devices by specifications, on simulated machines.
#include <catch2/catch.hpp>

#include "device/choice.h"
#include "errors.h"

using namespace phlux::device;
using Catch::Contains;
using Indices = std::vector<std::size_t>;

namespace {

DeviceInfo device(int platform_index, const std::string& platform, int device_index, const std::string& type,
                  const std::string& name) {
  DeviceInfo info;
  info.platform_index = platform_index;
  info.device_index = device_index;
  info.platform = platform;
  info.type = type;
  info.name = name;
  return info;
}

// PoCL's and Intel's driver for one processor, and two GPUs.
const std::vector<DeviceInfo> machine = {
    device(0, "NVIDIA CUDA", 0, "gpu", "NVIDIA H100"),
    device(1, "Portable Computing Language", 0, "cpu", "cpu-skylake-Intel(R) Xeon(R) Gold"),
    device(2, "Intel(R) OpenCL", 0, "cpu", "Intel(R) Xeon(R) Gold"),
    device(3, "Intel(R) OpenCL Graphics", 0, "gpu", "Intel(R) Arc(TM)"),
};

} // namespace

TEST_CASE("parts of platform names take precedence over parts of device names") {
  const Choice intel = choose({"intel"}, machine);
  CHECK(intel.devices == Indices{2, 3});
  CHECK(intel.notes.empty());
  CHECK(choose({"Intel(R) OpenCL"}, machine).devices == Indices{2, 3});
  CHECK(choose({"portable"}, machine).devices == Indices{1});
  CHECK(choose({"arc"}, machine).devices == Indices{3});
  CHECK(choose({"h100"}, machine).devices == Indices{0});
}

TEST_CASE("a device by its indices, and by its type") {
  CHECK(choose({"2:0"}, machine).devices == Indices{2});
  CHECK(choose({"gpu"}, machine).devices == Indices{0, 3});
  CHECK(choose({"gpu"}, machine).notes.empty());
  CHECK(choose({}, machine).devices == Indices{1});
  CHECK(choose({}, {machine[0]}).devices == Indices{0});
}

TEST_CASE("two drivers' CPUs are the same cores: a type and a part of a name take the first, and say so") {
  for (const char* specification : {"cpu", "xeon"}) {
    CAPTURE(specification);
    const Choice choice = choose({specification}, machine);
    CHECK(choice.devices == Indices{1});
    REQUIRE(choice.notes.size() == 1);
    CHECK_THAT(choice.notes[0], Contains("2:0 (Intel(R) OpenCL) uses the same cores as 1:0 (Portable"));
  }
  // Two CPUs of one driver are two processors.
  std::vector<DeviceInfo> sockets = {machine[1], machine[1], machine[2]};
  sockets[1].device_index = 1;
  CHECK(choose({"cpu"}, sockets).devices == Indices{0, 1});
}

TEST_CASE("the same cores are taken twice where the user names both, with a note") {
  for (const std::vector<std::string>& both :
       {std::vector<std::string>{"1:0", "2:0"}, {"portable", "2:0"}, {"cpu", "2:0"}}) {
    CAPTURE(both);
    const Choice choice = choose(both, machine);
    CHECK(choice.devices == Indices{1, 2});
    REQUIRE_FALSE(choice.notes.empty());
    CHECK_THAT(choice.notes.back(), Contains("use the same cores: each slows the other"));
  }
  const Choice all = choose({"all"}, machine);
  CHECK(all.devices == Indices{0, 1, 2, 3});
  CHECK(all.notes.size() == 1);
  CHECK(choose({"1:0", "1:0"}, machine).notes.empty());
}

TEST_CASE("a specification without a match is refused with a list of devices") {
  for (const char* wrong : {"amd", "", "9:0", "1.5:0", ":0"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(choose({wrong}, machine), phlux::DeviceError);
    CHECK_THROWS_WITH(choose({"all", wrong}, machine),
                      Contains("1:0 (cpu) cpu-skylake-Intel(R) Xeon(R) Gold, Portable"));
  }
}
