#include <catch2/catch.hpp>

#include <algorithm>

#include <fmt/format.h>

#include "device/device.h"
#include "environment.h"
#include "errors.h"

using namespace phlux::device;
using Catch::Contains;

TEST_CASE("listed devices can be used") {
  const auto devices = list_devices();
  REQUIRE_FALSE(devices.empty());
  for (const auto& each : devices) {
    CAPTURE(each.platform, each.name);
    CHECK_FALSE(each.platform.empty());
    CHECK_FALSE(each.name.empty());
    CHECK_FALSE(each.driver.empty());
    CHECK_THAT(each.opencl_c_version, Contains("OpenCL C "));
    CHECK(each.compute_units > 0);
    CHECK(each.global_memory >= each.largest_buffer);
    CHECK(each.largest_buffer >= 1u << 20);
    CHECK((each.type == "cpu" || each.type == "gpu" || each.type == "accelerator"));
    CHECK((each.lanes == 1 || each.lanes == 4 || each.lanes == 8 || each.lanes == 16));
    if (each.type != "cpu") CHECK(each.lanes == 1);
    CHECK(static_cast<std::uint32_t>(each.lanes) <= std::max(1u, each.native_float_width));
  }
}

TEST_CASE("platforms are listed with those that have no devices") {
  const auto platforms = list_platforms();
  std::size_t devices = 0;
  for (const auto& each : platforms) {
    CAPTURE(each.name);
    CHECK_THAT(each.version, Catch::StartsWith("OpenCL "));
    devices += static_cast<std::size_t>(each.devices);
  }
  CHECK(devices == list_devices().size());
}

TEST_CASE("a device by its indices, type and parts of its names") {
  const auto wanted = list_devices().front();
  const auto is_among = [&](const std::vector<Device>& devices) {
    return std::any_of(devices.begin(), devices.end(), [&](const Device& each) {
      return each.info.platform_index == wanted.platform_index &&
             each.info.device_index == wanted.device_index;
    });
  };
  const auto indices = fmt::format("{}:{}", wanted.platform_index, wanted.device_index);
  const auto by_indices = open_devices({indices});
  REQUIRE(by_indices.size() == 1);
  CHECK(is_among(by_indices));

  std::string upper = wanted.name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](char c) { return static_cast<char>(std::toupper(c)); });
  CHECK(is_among(open_devices({upper})));
  CHECK(is_among(open_devices({wanted.name.substr(wanted.name.size() / 2)})));
  CHECK(is_among(open_devices({wanted.platform})));
  CHECK(open_devices({"all"}).size() == list_devices().size());
  if (wanted.type != "accelerator") CHECK(is_among(open_devices({wanted.type})));

  SECTION("named twice, it comes once, with the same context") {
    const auto twice = open_devices({indices, wanted.name, indices});
    CHECK(std::count_if(twice.begin(), twice.end(), [&](const Device& each) {
            return each.context() == by_indices.front().context();
          }) == 1);
  }
}

TEST_CASE("without a specification: PHLUX_DEVICE, else the first CPU") {
  const auto listed = list_devices();
  {
    const Environment preset("PHLUX_DEVICE", "");
    const auto chosen = open_devices({});
    REQUIRE(chosen.size() == 1);
    if (std::any_of(listed.begin(), listed.end(), [](const DeviceInfo& each) { return each.type == "cpu"; }))
      CHECK(chosen.front().info.type == "cpu");
  }
  const Environment preset("PHLUX_DEVICE", "no such thing");
  CHECK_THROWS_AS(open_devices({}), phlux::DeviceError);
  CHECK_NOTHROW(open_devices({"all"}));
}

TEST_CASE("a specification that names nothing says what there is") {
  const auto first = list_devices().front();
  for (const std::string wrong : {"no such device", "99:0", "0:99", "", "0:", ":0", "1.5:0"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(open_devices({wrong}), phlux::DeviceError);
    CHECK_THROWS_WITH(open_devices({wrong}), Contains("'" + wrong + "'") && Contains(first.name));
    CHECK_THROWS_AS(open_devices({"all", wrong}), phlux::DeviceError);
  }
}
