#include <filesystem>
#include <limits>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "files/exr.h"
#include "temporary_folder.h"

using phlux::files::Image;
using phlux::files::write_exr;

namespace {

Image constant(int width, int height, float value) {
  const std::vector<float> values(static_cast<std::size_t>(width * height), value);
  return {width, height, {{"R", values}, {"G", values}, {"B", values}}, {}};
}

} // namespace

TEST_CASE("phlux compare prints the figures") {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", constant(2, 2, 3.0F));
  write_exr(folder / "b.exr", constant(2, 2, 2.0F));
  const Outcome text = run({{"compare", "a.exr", "b.exr"}, folder.path(), {}, {}});
  CHECK(text.exit_code == 0);
  CHECK(text.err.empty());
  CHECK_THAT(text.out, Catch::Contains("mean_ratio      1.5\n"));
  CHECK_THAT(text.out, Catch::Contains("mean_b_rgb      2.0 2.0 2.0\n"));
  const Outcome json = run({{"compare", "a.exr", "b.exr", "--json"}, folder.path(), {}, {}});
  CHECK(json.exit_code == 0);
  CHECK(nlohmann::json::parse(json.out)["rmse"] == 1.0);
}

TEST_CASE("phlux compare fails for images that cannot be compared") {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", constant(2, 2, 1.0F));
  SECTION("another size") {
    write_exr(folder / "b.exr", constant(2, 3, 1.0F));
  }
  SECTION("no green") {
    Image image = constant(2, 2, 1.0F);
    image.channels.erase("G");
    write_exr(folder / "b.exr", image);
  }
  SECTION("no image") {
    folder.write("b.exr", "text");
  }
  SECTION("no file") {}
  const Outcome outcome = run({{"compare", "a.exr", "b.exr", "--json"}, folder.path(), {}, {}});
  CHECK(outcome.exit_code == 3);
  CHECK(outcome.is_one_line_error());
  CHECK(outcome.out.empty());
  if (!std::filesystem::exists(folder / "b.exr"))
    CHECK_THAT(outcome.err, Catch::EndsWith(": an existing OpenEXR image is needed\n"));
}

TEST_CASE("phlux compare ends with 1 if values are not finite, and prints the figures") {
  const TemporaryFolder folder;
  Image image = constant(2, 2, 1.0F);
  write_exr(folder / "b.exr", image);
  image.channels["R"][0] = std::numeric_limits<float>::quiet_NaN();
  write_exr(folder / "a.exr", image);
  const Outcome outcome = run({{"compare", "a.exr", "b.exr", "--json"}, folder.path(), {}, {}});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.is_one_line_error());
  CHECK(nlohmann::json::parse(outcome.out)["nonfinite"] == 1);
}

TEST_CASE("phlux compare --fail-above ends with 1 and a line for each metric above its value") {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", constant(2, 2, 3.0F));
  write_exr(folder / "b.exr", constant(2, 2, 2.0F)); // rmse 1, mean_error 0.5
  write_exr(folder / "black.exr", constant(2, 2, 0.0F));
  Image image = constant(2, 2, 2.0F);
  image.channels["R"][0] = std::numeric_limits<float>::quiet_NaN();
  write_exr(folder / "nan.exr", image);
  struct Case {
    std::vector<std::string> arguments;
    int exit_code;
    std::string errors;
  };
  const std::string left_out =
      "phlux: 1 values of nan.exr and b.exr are not finite: their pixels are left out of the metrics\n";
  const std::vector<Case> cases = {
      {{"a.exr", "b.exr", "--fail-above", "rmse=1", "--fail-above=mean_error=0.5"}, 0, ""},
      {{"a.exr", "b.exr", "--fail-above", "rmse=.99", "--fail-above", "relmse=1", "--fail-above",
        "mean_error=4e-1"},
       1,
       "phlux: rmse is 1.0: must be at most 0.99\nphlux: mean_error is 0.5: must be at most 0.4\n"},
      {{"black.exr", "black.exr", "--fail-above", "mean_error=1e300"},
       1,
       "phlux: mean_error is undefined: must be at most 1e+300\n"},
      {{"a.exr", "black.exr", "--fail-above", "mean_error=1e300"},
       1,
       "phlux: mean_error is infinite: must be at most 1e+300\n"},
      {{"nan.exr", "b.exr", "--fail-above", "nonfinite=1"}, 0, left_out},
      {{"nan.exr", "b.exr", "--fail-above", "rmse=1"}, 1, left_out},
      {{"nan.exr", "b.exr", "--fail-above", "nonfinite=0"},
       1,
       left_out + "phlux: nonfinite is 1: must be at most 0\n"},
  };
  for (auto [arguments, exit_code, errors] : cases) {
    arguments.insert(arguments.begin(), "compare");
    arguments.emplace_back("--json");
    const Outcome outcome = run({arguments, folder.path(), {}, {}});
    CAPTURE(arguments);
    CHECK(outcome.exit_code == exit_code);
    CHECK(outcome.err == errors);
    CHECK(nlohmann::json::accept(outcome.out));
  }
  const Outcome no_variance =
      run({{"compare", "a.exr", "b.exr", "--fail-above", "max_z=5"}, folder.path(), {}, {}});
  CHECK(no_variance.exit_code == 2);
  CHECK(no_variance.is_one_line_error());
  CHECK_THAT(no_variance.err, Catch::Contains("--moments, or use one of mean_error, rmse, relmse, "
                                              "relmse_trimmed, nonfinite\n"));
  CHECK(no_variance.out.empty());
}

TEST_CASE("phlux compare --png writes a picture, and never over an image") {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", constant(2, 2, 3.0F));
  write_exr(folder / "b.exr", constant(2, 3, 2.0F));
  std::filesystem::create_symlink("a.exr", folder / "link.png");
  const auto compare = [&](const std::string& reference, const std::string& picture) {
    return run({{"compare", "a.exr", reference, "--png", picture}, folder.path(), {}, {}});
  };
  CHECK(compare("a.exr", "picture.png").exit_code == 0);
  CHECK_THAT(TemporaryFolder::read(folder / "picture.png"), Catch::StartsWith("\x89PNG"));
  CHECK(run({{"compare", "a.exr", "b.exr", "--html", "flip.html"}, folder.path(), {}, {}}).exit_code == 3);
  CHECK(run({{"compare", "a.exr", "a.exr", "--html", "flip.html"}, folder.path(), {}, {}}).exit_code == 0);
  CHECK_THAT(TemporaryFolder::read(folder / "flip.html"),
             Catch::StartsWith("<!doctype html>") && Catch::Contains(";base64,iVBORw0KGgo"));
  struct Case {
    std::string reference, picture;
    int exit_code;
    std::string message;
  };
  for (const auto& [reference, picture, exit_code, message] :
       std::vector<Case>{{"a.exr", "link.png", 2, "link.png: named for an output, but is the input a.exr"},
                         {"a.exr", "a.exr", 2, "--png a.exr: the picture is a PNG file, such as a.png"},
                         {"a.exr", "new.jpg", 2, "such as new.png"},
                         {"a.exr", "missing/new.png", 5, "missing/new.png: cannot be written"},
                         {"b.exr", "new.png", 3, "only images of one size can be compared"}}) {
    const Outcome outcome = compare(reference, picture);
    CAPTURE(picture);
    CHECK(outcome.exit_code == exit_code);
    CHECK(outcome.is_one_line_error());
    CHECK_THAT(outcome.err, Catch::Contains(message));
    CHECK(outcome.out.empty());
  }
  const Outcome both =
      run({{"compare", "a.exr", "b.exr", "--png", "p", "--html", "./p"}, folder.path(), {}, {}});
  CHECK(both.exit_code == 2);
  CHECK(both.is_one_line_error());
  CHECK_THAT(both.err, Catch::Contains("./p: named for two outputs"));
  CHECK(phlux::files::read_exr(folder / "a.exr").width == 2);
  CHECK(folder.names() == std::set<std::string>{"a.exr", "b.exr", "flip.html", "link.png", "picture.png"});
}

TEST_CASE("phlux devices lists every device and marks the default") {
  const TemporaryFolder folder;
  const Outcome table = run({{"devices"}, folder.path(), {}, {}});
  CHECK(table.exit_code == 0);
  CHECK_THAT(table.out, Catch::StartsWith("DEVICE") && Catch::Contains(":0 *"));
  const Outcome json = run({{"devices", "--json"}, folder.path(), {}, {}});
  const nlohmann::json devices = nlohmann::json::parse(json.out);
  REQUIRE(devices.size() > 0);
  int defaults = 0;
  for (const nlohmann::json& device : devices) {
    defaults += device.at("default").get<bool>() ? 1 : 0;
    const int width = device.at("width");
    CHECK((width == 1 || width == 4 || width == 8 || width == 16));
    for (const char* key : {"device", "platform", "type", "name", "driver", "opencl_c_version"})
      CHECK(device.at(key).is_string());
    CHECK(device.at("doubles").is_boolean());
    for (const char* key : {"compute_units", "global_memory", "largest_buffer", "native_float_width"})
      CHECK(device.at(key) > 0);
  }
  CHECK(defaults >= 1);
}

namespace {

constexpr const char* system_vendors = "/etc/OpenCL/vendors";

// A folder of drivers for the loader: one without devices, and those of the system if requested.
void write_vendors(const TemporaryFolder& folder, bool with_system) {
  folder.write("nothing.icd", PHLUX_DRIVER_OF_NOTHING "\n");
  if (with_system)
    for (const auto& entry : std::filesystem::directory_iterator(system_vendors))
      std::filesystem::copy_file(entry.path(), folder / entry.path().filename());
}

} // namespace

TEST_CASE("A platform without devices is listed, and no command warns of it") {
  if (!std::filesystem::exists(system_vendors)) return; // the system keeps its drivers elsewhere
  const TemporaryFolder vendors, folder;
  write_vendors(vendors, true);
  const std::map<std::string, std::string> environment = {{"OCL_ICD_VENDORS", vendors.path()}};
  const Outcome devices = run({{"devices"}, folder.path(), environment, {}});
  CHECK(devices.exit_code == 0);
  CHECK(devices.err.empty());
  CHECK_THAT(devices.out, Catch::Contains(", Driver of nothing, has no devices\n"));
  CHECK(run({{"devices", "--json"}, folder.path(), environment, {}}).err.empty());
  const Outcome version = run({{"--version"}, folder.path(), environment, {}});
  CHECK_THAT(version.out, Catch::Contains(" Driver of nothing, OpenCL 1.2 nothing, 0 devices"));
  const Outcome wrong = run({{"verify", "--device", "no such device"}, folder.path(), environment, {}});
  CHECK(wrong.exit_code == 4);
  CHECK(wrong.is_one_line_error());
  CHECK_THAT(wrong.err, Catch::EndsWith("; Driver of nothing has no devices\n"));
}

TEST_CASE("If no platform has devices, the error names the platforms") {
  const TemporaryFolder vendors, folder;
  write_vendors(vendors, false);
  const Outcome outcome = run({{"devices"}, folder.path(), {{"OCL_ICD_VENDORS", vendors.path()}}, {}});
  CHECK(outcome.exit_code == 4);
  CHECK(outcome.is_one_line_error());
  CHECK_THAT(outcome.err, Catch::Contains("no OpenCL device: Driver of nothing has no devices: install"));
}
