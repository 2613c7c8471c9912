#include <catch2/catch.hpp>
#include <sys/stat.h>

#include "files/exr.h"

#include "cli/program.h"
#include "cli/scenes.h"
#include "device/environment.h"
#include "film/paged_array.h"

namespace {

// The error for a bad file names the file and the reason, and nothing else; no file is written.
void check_rejected(const TemporaryFolder& folder, const std::vector<std::string>& arguments, int exit_code,
                    const std::map<std::string, std::string>& environment = {}) {
  const std::set<std::string> before = folder.names();
  const Outcome outcome = run({arguments, folder.path(), environment, {}});
  CAPTURE(arguments, outcome.out, outcome.err);
  CHECK(outcome.exit_code == exit_code);
  CHECK(outcome.is_one_line_error());
  CHECK(outcome.out.empty());
  CHECK(folder.names() == before);
}

struct BadScene {
  std::string what, text;
};

std::string phong(const std::string& exponent, const std::string& kd, const std::string& ks) {
  return sphere_of("<bsdf type=\"phong\"><float name=\"exponent\" value=\"" + exponent +
                   "\"/><rgb name=\"diffuseReflectance\" value=\"" + kd +
                   "\"/><rgb name=\"specularReflectance\" value=\"" + ks + "\"/></bsdf>");
}

std::string transformed(const std::string& transform) {
  return "<shape type=\"sphere\"><transform name=\"toWorld\">" + transform + "</transform></shape>\n";
}

const std::vector<BadScene> bad_scenes = {
    {"an empty file", ""},
    {"malformed XML", "<scene version=\"0.6.0\">\n<shape type=\"sphere\"\n</scene>\n"},
    {"not a scene", "<html></html>"},
    {"an unknown plugin", scene_with("<shape type=\"torus\"/>" + light)},
    {"kd + ks > 1", scene_with(phong("10", ".7", ".7") + light)},
    {"a negative exponent", scene_with(phong("-1", ".5", ".2") + light)},
    {"a transform with NaN", scene_with(transformed("<translate x=\"nan\"/>") + light)},
    {"a singular transform", scene_with(transformed("<scale x=\"0\"/>") + light)},
    {"a missing mesh",
     scene_with("<shape type=\"obj\"><string name=\"filename\" value=\"no.obj\"/></shape>" + light)},
    {"indices out of range",
     scene_with("<shape type=\"obj\"><string name=\"filename\" value=\"bad.obj\"/></shape>" + light)},
    {"a film of 0x0 pixels", scene_with(sphere_of("") + light, "0 0")},
    {"a film of -1x5 pixels", scene_with(sphere_of("") + light, "-1 5")},
    {"an undefined variable", scene_with(sphere_of("") + "<emitter type=\"constant\"><rgb name=\"radiance\" "
                                                         "value=\"$undefined\"/></emitter>")},
};

} // namespace

TEST_CASE("Bad scenes are one line with FILE:LINE and exit code 3") {
  const TemporaryFolder folder;
  folder.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n");
  for (const auto& [what, text] : bad_scenes) {
    CAPTURE(what);
    folder.write("scene.xml", text);
    check_rejected(folder, {"render", "scene.xml"}, 3);
  }
  const Outcome malformed = run({{"render", "scene.xml"}, folder.path(), {}, {}});
  CHECK_THAT(malformed.err, Catch::StartsWith("phlux: scene.xml:"));
}

TEST_CASE("A missing scene is one line and exit code 3") {
  const TemporaryFolder folder;
  check_rejected(folder, {"render", "missing.xml"}, 3);
  check_rejected(folder, {"render", "."}, 3);
}

TEST_CASE("Unwritable outputs are found before rendering: one line, exit code 5, no file") {
  const TemporaryFolder folder;
  folder.write("scene.xml", good_scene);
  folder.write("file", "");
  for (const std::string option : {"--output", "--png", "--stats"})
    for (const std::string path : {"missing/a", "file/a", ".", "/proc/a"}) {
      // Hours of samples: this only ends in time if the check precedes rendering.
      check_rejected(folder, {"render", "scene.xml", "-n", "100000000", option, path}, 5);
    }
}

TEST_CASE("No matching device is one line and exit code 4") {
  const TemporaryFolder folder;
  folder.write("scene.xml", good_scene);
  const std::map<std::string, std::string> no_platform = {{"OCL_ICD_VENDORS", "/nonexistent"}};
  check_rejected(folder, {"render", "scene.xml"}, 4, no_platform);
  check_rejected(folder, {"devices"}, 4, no_platform);
  check_rejected(folder, {"render", "scene.xml", "--device", "no such device"}, 4);
  check_rejected(folder, {"render", "scene.xml", "--device", "99:0"}, 4);
  check_rejected(folder, {"render", "scene.xml"}, 4, {{"PHLUX_DEVICE", "no such device"}});
}

TEST_CASE("Kernels that do not build are one line and exit code 4") {
  const TemporaryFolder folder;
  folder.write("scene.xml", good_scene);
  std::filesystem::create_directory(folder / "kernels");
  check_rejected(folder, {"render", "scene.xml", "--kernel-dir", "kernels"}, 4);
}

TEST_CASE("An empty scene is an error that names the file, exit code 3, no file") {
  const TemporaryFolder folder;
  folder.write("scene.xml", scene_with(light));
  const Outcome outcome = run({{"render", "scene.xml"}, folder.path(), {}, {}});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.err, Catch::Contains("phlux: scene.xml") && Catch::Contains("no shapes"));
  CHECK(folder.names() == std::set<std::string>{"scene.xml"});
}

TEST_CASE("Recoverable problems are warnings that name the cause") {
  const TemporaryFolder folder;
  folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n");
  const std::vector<BadScene> odd_scenes = {
      {"no light", scene_with(sphere_of(""))},
      {"area",
       scene_with("<shape type=\"obj\"><string name=\"filename\" value=\"flat.obj\"/></shape>" + light)}};
  for (const auto& [what, text] : odd_scenes) {
    folder.write("scene.xml", text);
    const Outcome outcome = run({{"render", "scene.xml"}, folder.path(), {}, {}});
    CAPTURE(what, outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.err, Catch::StartsWith("phlux: warning: ") && Catch::Contains(what));
    CHECK(std::filesystem::exists(folder / "scene.exr"));
  }
}

#ifndef __SANITIZE_ADDRESS__ // which takes terabytes of address space
TEST_CASE("A render that needs more memory than there is says so before it begins") {
  const TemporaryFolder folder;
  folder.write("scene.xml", good_scene);
  const Outcome outcome = run({{"render", "scene.xml", "--size", "8192x8192", "-i", "bidir", "-n", "1000000"},
                               folder.path(),
                               {},
                               {},
                               {},
                               std::size_t{4} << 30});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.is_one_line_error());
  CHECK_THAT(outcome.err, Catch::Contains("8192x8192 pixels need 8.59 GB of memory, and ") &&
                              Catch::Contains("or --integrator path (or light), which needs 4.29 GB"));
}
#endif

TEST_CASE("Where memory is short, sums of samples are kept in a file, and the image is the same") {
  const std::string disk = std::filesystem::current_path();
  {
    const Environment variable("TMPDIR", disk);
    if (phlux::film::ScratchFile::room() == 0.0) return; // the build is in memory
  }
  const TemporaryFolder folder;
  folder.write("scene.xml", good_scene);
  const auto render = [&](std::vector<std::string> options, const std::string& folder_of_file) {
    options.insert(options.begin(), {"render", "scene.xml", "--size", "64x48", "-i", "bidir", "-n", "40",
                                     "--moments", "--png", "none", "-q"});
    Invocation how;
    how.arguments = options;
    how.folder = folder.path();
    how.environment = {{"TMPDIR", folder_of_file}};
    return run(how);
  };
  REQUIRE(render({"-o", "memory.exr"}, disk).exit_code == 0);
  const Outcome outcome = render({"-o", "file.exr", "--memory", "3e-4", "--checkpoint", "c"}, disk);
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.err,
             Catch::Contains("64x48 pixels need 0.000393 GB of memory, and 0.0003 GB are allowed "
                             "by --memory: 0.000197 GB of them are in a file in "));
  const auto whole = phlux::files::read_exr(folder / "memory.exr").channels;
  CHECK(phlux::files::read_exr(folder / "file.exr").channels == whole);
  REQUIRE(render({"-o", "on.exr", "--resume", "c", "--memory", "3e-4"}, disk).exit_code == 0);
  CHECK(phlux::files::read_exr(folder / "on.exr").channels == whole);

  const Outcome refused = render({"--memory", "3e-4"}, "/proc");
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.err, Catch::Contains("or 0.000197 GB on a disk, in a folder named by the variable "
                                          "TMPDIR (in /proc there are 0 GB)"));
}

TEST_CASE("Radiances that single precision cannot hold beside the lights are wrong usage") {
  const TemporaryFolder folder;
  folder.write("scene.xml", good_scene);
  check_rejected(folder, {"render", "scene.xml", "-D", "radiance=1e-25", "--clamp", "1e20"}, 2);
  check_rejected(folder, {"render", "scene.xml", "-D", "radiance=1e-25", "--ambient", "1e20"}, 2);
}

TEST_CASE("Pipes and devices in the place of files are refused at once; names cannot control the terminal") {
  const TemporaryFolder folder;
  folder.write("scene.xml", good_scene);
  folder.write("evil\x1b[2J.xml", "<scene/>");
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  check_rejected(folder, {"render", "pipe"}, 3);
  check_rejected(folder, {"render", "/dev/zero"}, 3);
  check_rejected(folder, {"compare", "pipe", "pipe"}, 3);
  check_rejected(folder, {"merge", "pipe", "pipe", "-o", "m.exr"}, 3);
  check_rejected(folder, {"render", "scene.xml", "--strategy", "pipe"}, 2);
  const Outcome outcome = run({{"render", "evil\x1b[2J.xml"}, folder.path(), {}, {}});
  CHECK_THAT(outcome.err, Catch::StartsWith("phlux: evil?[2J.xml:1: "));
}

TEST_CASE("A damaged cache of the driver is built anew, and the image is the same") {
  const TemporaryFolder folder;
  folder.write("scene.xml", good_scene);
  const std::filesystem::path cache = folder / "cache";
  const auto render = [&](const std::string& name) {
    const Outcome outcome =
        run({{"render", "scene.xml", "-q", "-n", "4", "--png", "none", "-o", name, "--stats", "stats.json"},
             folder.path(),
             {{"POCL_CACHE_DIR", cache.string()}, {"PHLUX_CACHE_DIR", (folder / "own").string()}},
             {}});
    CHECK(outcome.exit_code == 0);
    return TemporaryFolder::read(folder / "stats.json").find("\"kernel_cache\": \"hit\"") !=
           std::string::npos;
  };
  const auto channels = [&](const std::string& name) {
    return phlux::files::read_exr(folder / name).channels;
  };
  CHECK_FALSE(render("first.exr"));
  CHECK(render("again.exr"));
  for (const bool flip : {false, true}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(cache)) {
      if (!entry.is_regular_file() || entry.file_size() == 0) continue;
      std::string bytes = TemporaryFolder::read(entry.path());
      bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
      if (!flip) bytes.resize(bytes.size() / 2);
      std::filesystem::permissions(entry.path(), std::filesystem::perms::owner_all);
      std::ofstream(entry.path(), std::ios::binary | std::ios::trunc) << bytes;
    }
    CHECK_FALSE(render("damaged.exr"));
    CHECK(channels("damaged.exr") == channels("first.exr"));
    CHECK(render("damaged.exr")); // recorded again
  }
}
