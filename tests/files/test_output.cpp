#include "files/output.h"

#include <csignal>
#include <vector>

#include <sys/resource.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "errors.h"
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
