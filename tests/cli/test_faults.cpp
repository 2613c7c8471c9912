// What terminals, disks and devices do to a render does not lose it.
#include <cerrno>
#include <iostream>
#include <random>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/workplace.h"
#include "repetitions.h"

namespace fs = std::filesystem;
using Catch::Contains;
using phlux::files::Image;
using Names = std::set<std::string>;

namespace {

struct Renders : Workplace {
  Outcome render(std::vector<std::string> arguments, Invocation how = {}) const {
    arguments.insert(arguments.begin(), {"render", "scene.xml"});
    how.arguments = arguments;
    how.folder = path();
    return run(how);
  }
};

Invocation with(std::map<std::string, std::string> environment) {
  Invocation how;
  how.environment = std::move(environment);
  return how;
}

Invocation with_streams(std::map<int, std::string> streams) {
  Invocation how;
  how.streams = std::move(streams);
  return how;
}

std::string fault(const std::string& plan, int code) {
  return plan + " " + std::to_string(code);
}

constexpr int invalid_command_queue = -36, out_of_resources = -5;

} // namespace

TEST_CASE("No state of standard error and output ends a render") {
  const Renders place;
  const std::vector<std::string> arguments = {"-n", "16", "--verbose", "--stats", "s.json"};
  for (const std::string where : {"/dev/full", "closed", "broken pipe"}) {
    CAPTURE(where);
    for (const char* name : {"scene.exr", "scene.png", "s.json"}) fs::remove(place / name);
    CHECK(place.render(arguments, with_streams({{2, where}})).exit_code == 0);
    CHECK(place.names() == Names{"scene.xml", "scene.exr", "scene.png", "s.json"});
    CHECK(place.image().info.samples == 16.0);
    fs::remove(place / "scene.exr");
    const Outcome mute = place.render(arguments, with_streams({{1, where}}));
    CHECK(mute.exit_code == 5);
    CHECK_THAT(mute.err, Contains("phlux: standard output: cannot be written: "));
    CHECK(place.image().info.samples == 16.0);
  }
  CHECK(place.render({"-n", "16", "-q"}, with_streams({{1, "closed"}, {2, "closed"}})).exit_code == 0);
}

TEST_CASE("A benchmark whose reader is gone still writes its table, and says why at the end") {
  const Workplace place;
  Invocation how = with_streams({{1, "broken pipe"}});
  how.arguments = {"bench",  "sampling",   "--quick", "--case", ".4,.05,50,30", "--samples",
                   "100000", "--strategy", "exact",   "--out",  "results"};
  how.folder = place.path();
  const Outcome outcome = run(how);
  CHECK(outcome.exit_code == 5);
  CHECK(outcome.err == "phlux: standard output: cannot be written: Broken pipe\n");
  CHECK(fs::exists(place / "results/sampling.csv"));
}

TEST_CASE("Each output is written that can be; the image, if need be, to TMPDIR") {
  const Renders place;
  fs::create_directory(place / "tmp");
  const Outcome outcome = place.render(
      {"-n", "2", "-o", "/dev/full", "--png", "/dev/full", "--stats", "s.json", "--checkpoint", "/dev/full"},
      with({{"TMPDIR", place / "tmp"}}));
  CAPTURE(outcome.out, outcome.err);
  CHECK(outcome.exit_code == 5);
  CHECK_THAT(outcome.err, Contains("phlux: /dev/full: cannot be written: No space left on device: make room, "
                                   "or name a place with more; the image is in " +
                                   (place / "tmp").string()));
  std::size_t lines = 0;
  for (std::size_t at = 0; (at = outcome.err.find("phlux: /dev/full: ", at)) != std::string::npos; ++at)
    ++lines;
  CHECK(lines == 3); // image, checkpoint, preview
  CHECK(place.names() == Names{"scene.xml", "tmp", "s.json"});
  REQUIRE(std::distance(fs::directory_iterator(place / "tmp"), fs::directory_iterator()) == 1);
  const fs::path image = fs::directory_iterator(place / "tmp")->path();
  CHECK(phlux::files::read_exr(image).info.samples == 2.0);
  CHECK_THAT(outcome.out, Catch::StartsWith(image.string()));
}

TEST_CASE("No output replaces an input or another output, whatever their names") {
  const Renders place;
  place.write("mesh.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                          "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                          "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  std::string scene = good_scene;
  scene.insert(scene.rfind("</scene>"),
               "<shape type=\"ply\"><string name=\"filename\" value=\"mesh.ply\"/></shape>\n");
  place.write("scene.xml", scene);
  place.write("notes.txt", "notes");
  fs::create_symlink("scene.xml", place / "link");
  fs::create_hard_link(place / "mesh.ply", place / "hard");
  fs::create_symlink("new.exr", place / "dangling");
  REQUIRE(place.render({"-n", "1", "--png", "none", "--checkpoint", "c"}).exit_code == 0);
  fs::remove(place / "scene.exr");
  const Names names = place.names();
  const std::string checkpoint = TemporaryFolder::read(place / "c");
  const auto refused = [&](const std::vector<std::string>& options, const std::string& message) {
    const Outcome outcome = place.render(options);
    CAPTURE(options, outcome.err);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.is_one_line_error());
    CHECK_THAT(outcome.err, Contains(message));
    CHECK(TemporaryFolder::read(place / "scene.xml") == scene);
    CHECK(place.names() == names);
  };
  for (const char* option : {"-o", "--png", "--stats", "--checkpoint"})
    refused({option, "scene.xml"}, "scene.xml: named for an output, but it is an input");
  refused({"--stats", "mesh.ply"}, "mesh.ply: named for an output, but it is an input");
  refused({"-o", "link"}, "link: named for an output, but is the input scene.xml");
  refused({"--stats", "hard"}, "hard: named for an output, but is the input mesh.ply");
  refused({"--resume", "c", "-o", "c"}, "c: named for two outputs");
  refused({"--resume", "c", "--checkpoint", "none", "-o", "./c"},
          "./c: named for an output, but is the input c");
  refused({"-o", "same", "--checkpoint", place / "same"}, "named for two outputs");
  refused({"-o", "new.exr", "--checkpoint", "dangling"}, "named for two outputs");
  refused({"--checkpoint", "notes.txt"}, "--checkpoint notes.txt: is not a checkpoint of phlux");
  CHECK(TemporaryFolder::read(place / "c") == checkpoint);

  place.write("empty", "");
  CHECK(place.render({"-n", "1", "--checkpoint", "empty", "--png", "none"}).exit_code == 0);
  CHECK_THAT(TemporaryFolder::read(place / "empty"), Catch::StartsWith("phlux checkpoint "));
  const Outcome merged = run({{"merge", "scene.exr", "other.exr", "-o", "scene.exr"}, place.path(), {}, {}});
  CHECK(merged.exit_code == 2);
}

TEST_CASE("Outputs that are pipes or links to themselves are errors, not waits") {
  const Renders place;
  fs::create_directory(place / "tmp");
  REQUIRE(::mkfifo((place / "pipe").c_str(), 0600) == 0);
  const Outcome pipe =
      place.render({"-n", "1", "-o", "pipe", "--checkpoint", "c"}, with({{"TMPDIR", place / "tmp"}}));
  CHECK(pipe.exit_code == 5);
  CHECK_THAT(pipe.err, Contains("pipe: cannot be written: No such device or address: a program must read"));
  CHECK(place.names() == Names{"scene.xml", "pipe", "tmp", "c"});
  fs::create_symlink("loop", place / "loop");
  for (const char* option : {"-o", "--checkpoint"}) {
    const Outcome loop = place.render({option, "loop"});
    CHECK(loop.exit_code == 5);
    CHECK(loop.is_one_line_error());
    CHECK_THAT(loop.err, Contains("loop: cannot be written: Too many levels of symbolic links"));
  }
}

TEST_CASE("A closed terminal ends a render as an interrupt does, unless nohup ignores it") {
  const Renders place;
  REQUIRE(place.render({"-n", "1"}).exit_code == 0); // fills the kernel cache
  Invocation how;
  how.interrupt_after = std::chrono::milliseconds(300);
  how.signal = SIGHUP;
  const Outcome outcome = place.render({"--time", "300", "--checkpoint", "c"}, how);
  CHECK(outcome.exit_code == 130);
  CHECK(place.image().info.samples > 0.0);
  CHECK(fs::exists(place / "c"));
  how.ignores_hangup = true;
  CHECK(place.render({"--time", "1", "-o", "b.exr"}, how).exit_code == 0);
}

TEST_CASE("A device that fails leaves image and checkpoint, from which the render resumes") {
  const Renders place;
  REQUIRE(place.render({"-n", "2000", "-o", "whole.exr", "--png", "none"}).exit_code == 0);
  const auto failing = [&](const std::string& plan, const std::string& image) {
    return place.render(
        {"-n", "2000", "-o", image, "--png", "none", "--checkpoint", "c", "--stats", "s.json"},
        with({{"LD_PRELOAD", PHLUX_DEVICE_FAULTS}, {"PHLUX_DEVICE_FAULT", plan}}));
  };
  const Outcome once = failing(fault("clEnqueueNDRangeKernel 3 1", invalid_command_queue), "once.exr");
  CAPTURE(once.err);
  CHECK(once.exit_code == 0);
  CHECK_THAT(once.err, Contains("clEnqueueNDRangeKernel: CL_INVALID_COMMAND_QUEUE: its work is repeated"));
  CHECK(place.image("once.exr").channels == place.image("whole.exr").channels);
  fs::remove(place / "c");

  const Outcome outcome = failing(fault("clEnqueueReadBuffer 5 1000000000", out_of_resources), "part.exr");
  CAPTURE(outcome.out, outcome.err);
  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err,
             Catch::EndsWith("): clEnqueueReadBuffer: CL_OUT_OF_RESOURCES: no device is left\n"));
  CHECK_THAT(outcome.out, Contains("interrupted: --resume c goes on"));
  CHECK(fs::exists(place / "s.json"));
  const double samples = place.image("part.exr").info.samples;
  CHECK(samples > 0.0);
  CHECK(samples < 2000.0);
  REQUIRE(place.render({"--resume", "c", "-o", "on.exr", "--png", "none"}).exit_code == 0);
  CHECK(place.image("on.exr").channels == place.image("whole.exr").channels);
}

TEST_CASE("A device that fails after a signal does not make an interrupted benchmark an error") {
  const Renders place;
  Invocation how =
      with({{"LD_PRELOAD", PHLUX_DEVICE_FAULTS},
            {"PHLUX_DEVICE_FAULT", fault("clEnqueueNDRangeKernel 0 1000000000", out_of_resources)}});
  how.folder = place.path();
  for (const std::string name : {"samplers", "remedies"}) {
    how.arguments = {"bench", name, "--quick", "--out", "tables"};
    how.interrupt_after = std::nullopt;
    const Outcome broken = run(how);
    CAPTURE(broken.err);
    CHECK(broken.exit_code == 4);
    how.interrupt_after = std::chrono::milliseconds(0);
    const Outcome interrupted = run(how);
    CAPTURE(interrupted.err, interrupted.out);
    CHECK(interrupted.exit_code == 130);
    CHECK_THAT(interrupted.out, Contains("interrupted: tables contains what was finished"));
  }
}

TEST_CASE("A failure while devices are looked for is an error of the device, or another one is used") {
  const Renders place;
  for (const std::string call :
       {"clGetPlatformIDs", "clGetPlatformInfo", "clGetDeviceIDs", "clGetDeviceInfo"}) {
    const Outcome outcome =
        place.render({"-n", "1"}, with({{"LD_PRELOAD", PHLUX_DEVICE_FAULTS},
                                        {"PHLUX_DEVICE_FAULT", fault(call + " 0 1", out_of_resources)}}));
    CAPTURE(call, outcome.err);
    CHECK_THAT(outcome.err, Contains("CL_OUT_OF_RESOURCES"));
    if (outcome.exit_code == 0) { // of another platform
      CHECK(call != "clGetPlatformIDs");
      CHECK_THAT(outcome.err, Contains("skipped"));
    } else {
      CHECK(outcome.exit_code == 4);
      CHECK_THAT(outcome.err, Contains("phlux: no OpenCL "));
    }
  }
}

// PoCL's driver "basic" is a second device on the same processor.
TEST_CASE("Of two devices, one goes on when the other fails") {
  const Renders place;
  const auto on_two = [&](const std::string& plan) {
    return place.render(
        {"-n", "10000", "-o", "two.exr", "--png", "none", "--device", "portable", "--stats", "s.json"},
        with({{"POCL_DEVICES", "pthread basic"},
              {"LD_PRELOAD", PHLUX_DEVICE_FAULTS},
              {"PHLUX_DEVICE_FAULT", plan}}));
  };
  if (on_two("none 0 0 0").err.find("each slows the other") == std::string::npos &&
      place.image("two.exr").info.device.find(", ") == std::string::npos)
    return; // another driver
  const Image whole = place.image("two.exr");
  const Outcome outcome = on_two(fault("clEnqueueNDRangeKernel 1 1000000000", invalid_command_queue) + " 0");
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("its work is repeated after a pause"));
  const Image image = place.image("two.exr");
  CHECK(image.info.samples == 10000.0);
  CHECK(image.channels == whole.channels);
  REQUIRE(place.render({"-n", "10000", "-o", "one.exr", "--png", "none"}).exit_code == 0);
  CHECK(image.channels == place.image("one.exr").channels);

  const Outcome without_threads = on_two(fault("pthread_create 0 1000000000", EAGAIN));
  CAPTURE(without_threads.err);
  CHECK(without_threads.exit_code == 0);
  CHECK_THAT(without_threads.err, Contains("no thread for it"));
  CHECK(place.image("two.exr").channels == whole.channels);
}

TEST_CASE("Whatever kills a render, it resumes to the image of an uninterrupted one") {
  const Renders place;
  constexpr const char* samples = "100000";
  REQUIRE(place.render({"-n", samples, "-o", "whole.exr", "--png", "none"}).exit_code == 0);
  std::mt19937 random(1);
  const int wanted = repetitions("PHLUX_KILLS", 20);
  int kills = 0, images = 0;
  for (int tries = 0; kills < wanted && tries < 3 * wanted; ++tries) {
    std::vector<std::string> arguments = {"-n",   samples, "--png", "none", "--checkpoint-every",
                                          "0.01", "-o",    "on.exr"};
    const bool begun = fs::exists(place / "c");
    arguments.insert(arguments.end(), {begun ? "--resume" : "--checkpoint", "c"});
    Invocation how;
    how.interrupt_after = std::chrono::milliseconds(random() % 60);
    how.signal = SIGKILL;
    if (tries % 4 != 0) how.after_write = place / "c"; // else while the render is set up
    const Outcome outcome = place.render(arguments, how);
    if (outcome.exit_code == 128 + SIGKILL) {
      ++kills;
      continue;
    }
    REQUIRE(outcome.exit_code == 0); // it was faster
    CHECK(place.image("on.exr").channels == place.image("whole.exr").channels);
    ++images;
    fs::remove(place / "c");
  }
  CHECK(kills == wanted);
  if (fs::exists(place / "c")) {
    REQUIRE(place.render({"--resume", "c", "-o", "on.exr", "--png", "none"}).exit_code == 0);
    CHECK(place.image("on.exr").channels == place.image("whole.exr").channels);
  }
  CHECK(place.names() == Names{"scene.xml", "whole.exr", "on.exr", "c"}); // no temporary files
  if (wanted > 20) std::cout << kills << " kills, " << images + 1 << " images, each the same\n";
}

TEST_CASE("Whichever writes fail, files are whole, and the exit code says whether all are there") {
  const Renders place;
  fs::create_directory(place / "out");
  fs::create_directory(place / "tmp");
  const int seeds = repetitions("PHLUX_FAULT_SEEDS", 5);
  int failed = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    for (const char* name : {"out/a.exr", "out/a.png", "out/s.json", "out/c"}) fs::remove(place / name);
    const Outcome outcome =
        place.render({"-n", "2", "-o", "out/a.exr", "--stats", "out/s.json", "--checkpoint", "out/c"},
                     with({{"LD_PRELOAD", PHLUX_FILE_FAULTS},
                           {"PHLUX_FILE_FAULTS", std::to_string(seed) + " 0.06 " + (place / "out").string()},
                           {"TMPDIR", place / "tmp"}}));
    CAPTURE(seed, outcome.err);
    CHECK((outcome.exit_code == 0 || outcome.exit_code == 5));
    failed += outcome.exit_code == 5 ? 1 : 0;
    if (outcome.exit_code == 0) CHECK(fs::exists(place / "out/s.json"));
    for (const auto& file : fs::directory_iterator(place / "out")) {
      CHECK(file.path().extension() != ".part");
      if (file.path().extension() == ".exr") CHECK(phlux::files::read_exr(file.path()).info.samples == 2.0);
    }
    const bool started = outcome.err.find("the image is in") != std::string::npos;
    if (started) CHECK_FALSE(fs::is_empty(place / "tmp"));
    if (fs::exists(place / "out/c"))
      CHECK(place.render({"--resume", "out/c", "-o", "b.exr", "--png", "none"}).exit_code == 0);
  }
  CHECK(failed > 0);
  CHECK(failed < seeds);
  if (seeds > 5) std::cout << failed << " of " << seeds << " renders could not write an output\n";
}
