// Renders by several processes.
#include <filesystem>
#include <random>
#include <utility>

#include <catch2/catch.hpp>

#include "cli/workplace.h"
#include "cluster/group.h"
#include "cluster/message.h"
#include "repetitions.h"

using namespace phlux::cluster;
using Catch::Contains;
using Texts = std::vector<std::string>;

TEST_CASE("processes divide the cores of a machine") {
  const std::vector<int> all = {0, 1, 2, 3, 8};
  CHECK(share_of({all}, 0) == all);
  CHECK(share_of({all, all}, 0) == std::vector{0, 1});
  CHECK(share_of({all, all}, 1) == std::vector{2, 3, 8});
  CHECK(share_of({{0}, {1}}, 1) == std::vector{1}); // mpirun has divided them
  for (std::size_t i = 0; i < 3; ++i) CHECK(share_of({{5, 6}, {5, 6}, {5, 6}}, i).size() == 1);
}

TEST_CASE("a message is read as it was written, and nothing is read beyond its end") {
  const std::vector<float> values = {1.0F, 2.0F, 3.0F};
  const Message message = packed(Kind::result, [&](Packer& to) {
    to.add(std::string("text"));
    to.add_array(values.data(), values.size());
    to.add(7);
  });
  Unpacker from(message);
  CHECK(from.take<Kind>() == Kind::result);
  CHECK(from.take_text() == "text");
  const float* const read = from.take_array<float>(values.size());
  CHECK(std::vector<float>(read, read + values.size()) == values);
  CHECK(from.take<int>() == 7);
  CHECK(from.take<std::uint64_t>() == 0);
  CHECK(from.take_array<float>(std::size_t{1} << 62) == nullptr);
}

TEST_CASE("A process that mpirun has started alone renders several scenes") {
  const Workplace place;
  place.write("other.xml", good_scene);
  const Outcome outcome = run({{"render", "scene.xml", "other.xml", "-n", "1", "-q"},
                               place.path(),
                               {{"OMPI_COMM_WORLD_SIZE", "1"}, {"OMPI_COMM_WORLD_RANK", "0"}},
                               {}});
  CHECK(outcome.exit_code == 0);
  CHECK(place.names().contains("other.exr"));
}

TEST_CASE("Processes that cannot reach each other, and other commands, are refused") {
  const Workplace place;
  for (const char* name : {"PMI", "OMPI_COMM_WORLD"})
    for (const Texts& arguments : {Texts{"render", "scene.xml", "-n", "1"}, Texts{"verify"}}) {
      const std::string prefix = name;
      if (prefix == "OMPI_COMM_WORLD" && arguments.front() == "render") continue; // MPI waits for its mpirun
      for (const std::string rank : {"0", "1"}) {
        Invocation how{arguments, place.path(), {{prefix + "_SIZE", "2"}, {prefix + "_RANK", rank}}, {}};
        const Outcome outcome = run(how);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.is_one_line_error() == (rank == "0"));
        if (rank == "0") CHECK_THAT(outcome.err, Contains("mpirun has started 2 processes"));
      }
    }
  CHECK(place.names() == std::set<std::string>{"scene.xml"});
}

#ifdef PHLUX_MPIRUN

namespace {

struct Cluster : Workplace {
  // By mpirun with these arguments; by the program alone without any.
  Outcome render(Texts arguments, const Texts& mpirun = {}, Invocation how = {}) const {
    arguments.insert(arguments.begin(), {"render", "scene.xml", "--png", "none"});
    how.arguments = arguments;
    how.folder = path();
    how.environment = {{"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                       {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
                       {"OMPI_MCA_btl_base_warn_component_unused", "0"},
                       {"OMPI_MCA_btl", "self,vader"}}; // nothing but this machine
    if (!mpirun.empty()) {
      how.launcher = {PHLUX_MPIRUN, "--oversubscribe"};
      how.launcher.insert(how.launcher.end(), mpirun.begin(), mpirun.end());
    }
    return run(how);
  }
  [[nodiscard]] bool same(const std::string& a, const std::string& b) const {
    return image(a).channels == image(b).channels;
  }
};

// Of renders that last three seconds on a fast machine: mpirun passes a signal on after one.
constexpr const char* samples = "400000";

} // namespace

TEST_CASE("Any number of processes renders the image of one, bit for bit") {
  const Cluster place;
  const std::string integrator = GENERATE("path", "light", "bidir");
  const Texts arguments = {"-i", integrator, "-n", "1500", "--moments"};
  const auto with = [&](const std::string& image) {
    Texts all = arguments;
    all.insert(all.end(), {"-o", image, "--stats", image + ".json"});
    return all;
  };
  REQUIRE(place.render(with("one.exr")).exit_code == 0);
  const std::string processes = integrator == "bidir" ? "4" : "2";
  const Outcome outcome = place.render(with("several.exr"), {"-n", processes});
  CAPTURE(outcome.out, outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(std::ranges::count(outcome.out, '\n') == 1);
  CHECK(place.same("several.exr", "one.exr"));
}

TEST_CASE("A signal to mpirun leaves a checkpoint, from which any number of processes resumes") {
  const Cluster place;
  const int wanted = repetitions("PHLUX_SIGNALS", 1);
  // The machine may have other work: mpirun passes the signal on after three seconds, and kills after three
  // more.
  const Texts slowly = {"-n", "2", "--mca", "odls_base_sigkill_timeout", "3"};
  const char* const samples = wanted == 1 ? ::samples : "1000000";
  REQUIRE(place.render({"-n", samples, "-o", "whole.exr"}).exit_code == 0);
  Invocation how;
  how.signal = SIGTERM;
  how.after_write = place / "c";
  const Texts to_checkpoint = {"-n", samples, "--checkpoint", "c", "--checkpoint-every", "0.02"};
  std::mt19937 random(1);
  const auto interrupt = [&](const Texts& mpirun) {
    std::filesystem::remove(place / "c");
    const Outcome broken = place.render(to_checkpoint, mpirun, how);
    CAPTURE(broken.out, broken.err);
    CHECK(broken.exit_code != 0);
    CHECK_THAT(broken.out, Contains("interrupted: --resume c goes on"));
  };
  for (int others = wanted - 1; others > 0; --others) {
    how.interrupt_after = std::chrono::milliseconds(random() % 1000);
    interrupt(slowly);
    REQUIRE(place.render({"--resume", "c", "-o", "on.exr"}, {"-n", "2"}).exit_code == 0);
    CHECK(place.same("on.exr", "whole.exr"));
  }
  how.interrupt_after = std::chrono::milliseconds(0);
  interrupt(wanted == 1 ? Texts{"-n", "2"} : slowly);
  std::filesystem::copy_file(place / "c", place / "d");
  for (const auto& [checkpoint, mpirun] : {std::pair("c", Texts{}), std::pair("d", Texts{"-n", "2"})}) {
    const Outcome resumed = place.render({"--resume", checkpoint, "-o", "on.exr"}, mpirun);
    CAPTURE(resumed.err);
    REQUIRE(resumed.exit_code == 0);
    CHECK(place.same("on.exr", "whole.exr"));
  }
}

namespace {

// Arguments of mpirun: the second of two processes is killed as soon as there is a file `c`.
Texts with_killed_process(const Texts& arguments, const Texts& options = {}) {
  Texts mpirun = options;
  mpirun.insert(mpirun.end(), {"-n", "1", PHLUX_PROGRAM, "render", "scene.xml", "--png", "none"});
  mpirun.insert(mpirun.end(), arguments.begin(), arguments.end());
  const char* const killed =
      "\"$@\" & process=$!; while ! [ -e c ]; do sleep .01; done; kill -KILL $process; "
      "wait $process";
  mpirun.insert(mpirun.end(), {":", "-n", "1", "sh", "-c", killed, "sh"});
  return mpirun;
}

} // namespace

TEST_CASE("When a process dies, the others' work is kept") {
  const Cluster place;
  REQUIRE(place.render({"-n", samples, "-o", "whole.exr"}).exit_code == 0);
  const Texts arguments = {"-n", samples, "--checkpoint", "c", "--checkpoint-every", "0.02"};
  const Outcome broken = place.render(arguments, with_killed_process(arguments));
  CAPTURE(broken.out, broken.err);
  CHECK(broken.exit_code != 0);
  CHECK_THAT(broken.out, Contains("interrupted: --resume c goes on"));
  REQUIRE(place.render({"--resume", "c", "-o", "on.exr"}).exit_code == 0);
  CHECK(place.same("on.exr", "whole.exr"));
}

TEST_CASE("Where mpirun lets the others go on when a process dies, they finish the render") {
  const Cluster place;
  // Messages of megabytes, one of which the process is likely to leave unfinished.
  const Texts arguments = {"-i", "light", "--size", "512x384", "-n", "60"};
  Texts alone = arguments, to_checkpoint = arguments;
  alone.insert(alone.end(), {"-o", "whole.exr"});
  to_checkpoint.insert(to_checkpoint.end(), {"--checkpoint", "c", "--checkpoint-every", "0.02"});
  REQUIRE(place.render(alone).exit_code == 0);
  const Outcome outcome =
      place.render(to_checkpoint, with_killed_process(to_checkpoint, {"--enable-recovery"}));
  CAPTURE(outcome.out, outcome.err);
  CHECK_THAT(outcome.err, Contains("no message from it for 30 s"));
  CHECK(std::ranges::count(outcome.out, '\n') == 1);
  CHECK(place.same("scene.exr", "whole.exr"));
}

TEST_CASE("A process that cannot help is left out, and an error is said once") {
  const Cluster place;
  REQUIRE(place.render({"-n", "64", "-o", "whole.exr"}).exit_code == 0);
  const Outcome alone =
      place.render({"-n", "64", "-D", "radiance=2"}, {"-n", "1", PHLUX_PROGRAM, "render", "scene.xml",
                                                      "--png", "none", "-n", "64", ":", "-n", "1"});
  CAPTURE(alone.err);
  CHECK(alone.exit_code == 0); // the options of process 0 are those of all
  CHECK(place.same("scene.exr", "whole.exr"));
  const Outcome wrong = place.render({"-n", "0"}, {"-n", "2"});
  CHECK(wrong.exit_code == 2);
  CHECK(wrong.err.find("phlux: ") == wrong.err.rfind("phlux: "));
}

TEST_CASE("A process that lacks the scene or the kernels is left out, with the name of the file") {
  const Cluster place;
  const std::filesystem::path elsewhere = place / "elsewhere";
  std::filesystem::create_directory(elsewhere);
  std::filesystem::create_directory_symlink(PHLUX_SOURCE_DIR "/kernels", place / "own");
  REQUIRE(place.render({"-n", samples, "-o", "whole.exr"}).exit_code == 0);
  for (const std::string missing : {"scene.xml", "own/transport/path.cl"}) {
    const Texts arguments = {"-n", samples, "--kernel-dir", "own"};
    Texts mpirun = {"-n", "1", PHLUX_PROGRAM, "render", "scene.xml", "--png", "none"};
    mpirun.insert(mpirun.end(), arguments.begin(), arguments.end());
    mpirun.insert(mpirun.end(), {":", "-n", "1", "-wdir", elsewhere});
    const Outcome outcome = place.render(arguments, mpirun);
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.err, Contains("warning: process 1: ") && Contains(": " + missing + ": "));
    CHECK(place.same("scene.exr", "whole.exr"));
    std::filesystem::copy_file(place / "scene.xml", elsewhere / "scene.xml",
                               std::filesystem::copy_options::overwrite_existing);
  }
}

#endif
