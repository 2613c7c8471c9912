#include "files/output.h"

#include <csignal>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "errors.h"
#include "faults/files.h"
#include "temporary_folder.h"

namespace fs = std::filesystem;
using phlux::WriteError;
using phlux::files::check_writable;
using phlux::files::write_file;

namespace {

// Writing beyond 1000 bytes fails, as on a full disk.
class FullDisk {
public:
  FullDisk() : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit small{1000, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }

private:
  rlimit old_{};
  void (*handler_)(int);
};

} // namespace

TEST_CASE("Files are written whole, over what was there") {
  const TemporaryFolder folder;
  write_file(folder / "a", "one");
  write_file(folder / "a", std::string("two\0three", 9));
  CHECK(TemporaryFolder::read(folder / "a") == std::string("two\0three", 9));
  CHECK(folder.names().size() == 1);
}

TEST_CASE("Checking leaves everything as it is") {
  const TemporaryFolder folder;
  check_writable(folder / "new");
  CHECK(folder.names().empty());
  write_file(folder / "old", "old");
  check_writable(folder / "old");
  CHECK(TemporaryFolder::read(folder / "old") == "old");
  CHECK(folder.names().size() == 1);
}

TEST_CASE("What cannot be written is a WriteError that names the file") {
  const TemporaryFolder folder;
  write_file(folder / "file", "x");
  const std::vector<fs::path> paths = {folder / "missing/a.exr", folder / "file/a.exr", folder.path(),
                                       "/proc/a.exr", ""};
  const fs::path& path = paths[GENERATE(range(std::size_t{0}, std::size_t{5}))];
  CAPTURE(path);
  CHECK_THROWS_AS(check_writable(path), WriteError);
  CHECK_THROWS_AS(write_file(path, "bytes"), WriteError);
  CHECK_THROWS_WITH(check_writable(path), Catch::StartsWith(path.string() + ": cannot be written: ") &&
                                              (Catch::EndsWith(": make its folder, or name another") ||
                                               Catch::EndsWith(": name a file in it")));
  CHECK(folder.names().size() == 1);
}

TEST_CASE("A write that fails half-way keeps the old file and leaves no partial one") {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  {
    const FullDisk full;
    CHECK_THROWS_AS(write_file(folder / "a", std::string(5000, 'x')), WriteError);
    CHECK_THROWS_AS(write_file(folder / "b", std::string(5000, 'x')), WriteError);
  }
  CHECK(TemporaryFolder::read(folder / "a") == "old");
  CHECK(folder.names().size() == 1);
}

TEST_CASE("A folder that vanishes after the check is an error, not a crash") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "sub");
  check_writable(folder / "sub/a");
  fs::remove_all(folder / "sub");
  CHECK_THROWS_AS(write_file(folder / "sub/a", "x"), WriteError);
}

TEST_CASE("Links stay links, and special files stay special") {
  const TemporaryFolder folder;
  write_file(folder / "target", "old");
  fs::create_symlink("target", folder / "link");
  write_file(folder / "link", "new");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(TemporaryFolder::read(folder / "target") == "new");

  check_writable("/dev/null");
  write_file("/dev/null", "bytes");
  CHECK(fs::is_character_file("/dev/null"));
  CHECK_THROWS_AS(write_file("/dev/full", "bytes"), WriteError);
}

TEST_CASE("What a dangling link points to is made; links in a circle are an error that names them") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "sub");
  fs::create_symlink("sub/new", folder / "link");
  check_writable(folder / "link");
  write_file(folder / "link", "bytes");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(TemporaryFolder::read(folder / "sub/new") == "bytes");
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  CHECK_THROWS_WITH(check_writable(folder / "a"), Catch::StartsWith((folder / "a").string() + ": cannot be"));
  CHECK_THROWS_WITH(write_file(folder / "a", "x"), Catch::Contains("links to itself"));
}

TEST_CASE("A pipe without a reader is an error, and nothing waits for one") {
  const TemporaryFolder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  check_writable(folder / "pipe"); // a reader may come
  CHECK_THROWS_WITH(write_file(folder / "pipe", "x"), Catch::Contains("a program must read from it"));
  const int reader = ::open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  write_file(folder / "pipe", "bytes");
  char bytes[8] = {};
  CHECK(::read(reader, bytes, sizeof bytes) == 5);
  ::close(reader);
}

TEST_CASE("Temporary files of dead writers are removed, those of others stay") {
  const TemporaryFolder folder;
  for (const char* name :
       {"a.0123456789ab.part", "a.ffffffffffff.part", "a.backup.part", "b.0123456789ab.part"})
    folder.write(name, "x");
  const int writer = ::open((folder / "a.ffffffffffff.part").c_str(), O_WRONLY);
  REQUIRE(::flock(writer, LOCK_EX) == 0);
  check_writable(folder / "a");
  CHECK(folder.names() ==
        std::set<std::string>{"a.ffffffffffff.part", "a.backup.part", "b.0123456789ab.part"});
  ::close(writer);
  check_writable(folder / "a");
  CHECK(folder.names() == std::set<std::string>{"a.backup.part", "b.0123456789ab.part"});
}

TEST_CASE("Names of one file are recognized, also of one that is yet to be written") {
  using phlux::files::same_file;
  const TemporaryFolder folder;
  folder.write("a", "x");
  folder.write("b", "x");
  fs::create_directory(folder / "sub");
  fs::create_symlink("a", folder / "link");
  fs::create_symlink("../new", folder / "sub/dangling");
  fs::create_hard_link(folder / "a", folder / "hard");
  for (const char* name : {"a", "./a", "sub/../a", "link", "hard"})
    CHECK(same_file(folder / "a", folder / name));
  for (const char* name : {"b", "new"}) CHECK_FALSE(same_file(folder / "a", folder / name));
  CHECK(same_file(folder / "new", folder / "sub/dangling"));
  CHECK_FALSE(same_file(folder / "new", folder / "sub/new"));
  CHECK_FALSE(same_file(folder / "new", folder / "other"));
}

TEST_CASE("Whichever calls fail, a file is the old or the new one, and an error says what it may be") {
  const TemporaryFolder folder;
  const std::string name = folder / "a";
  long faults_so_far = 0, errors = 0;
  std::string old = "old";
  write_file(name, old);
  for (unsigned seed = 0; seed < 300; ++seed) {
    const std::string text(1000 + seed, static_cast<char>('a' + seed % 26));
    faults::plan_file_faults(seed, 0.2, folder.path());
    bool failed = false;
    try {
      write_file(name, text);
    } catch (const WriteError&) {
      failed = true;
    }
    CHECK(failed == (faults::file_faults() > 0));
    faults_so_far += faults::file_faults();
    faults::plan_file_faults(0, 0, "");
    const std::string now = TemporaryFolder::read(name);
    CHECK((now == text || (failed && now == old)));
    CHECK(folder.names().size() == 1);
    errors += failed ? 1 : 0;
    old = now;
  }
  CHECK(errors > 100);
  CHECK(errors < 250);
  CHECK(faults_so_far >= errors);
}
