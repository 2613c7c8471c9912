#include <algorithm>
#include <sstream>

#include <catch2/catch.hpp>

#include "cli/program.h"
#include "temporary_folder.h"

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

long columns_of(const std::string& line) {
  return std::count(line.begin(), line.end(), ',') + 1;
}

} // namespace

TEST_CASE("phlux bench rays writes the contract's columns") {
  const TemporaryFolder folder;
  const Outcome outcome =
      run({{"bench", "rays", "--triangles", "36,1000", "--out", "out/new"}, folder.path(), {}, {}});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  const auto lines = lines_of(TemporaryFolder::read(folder / "out/new/rays.csv"));
  REQUIRE(lines.size() == 7);
  CHECK_THAT(lines[0],
             Catch::StartsWith("scene,triangles,kind,device,layout,mrays_per_s,embree_mrays_per_s,ratio"));
  for (const std::string& line : lines) CHECK(columns_of(line) == columns_of(lines[0]));
  for (const char* kind : {",camera,", ",bounce,", ",shadow,"})
    CHECK_THAT(outcome.out, Catch::Contains(kind));
}

TEST_CASE("phlux bench: bad input is one line and its exit code") {
  struct Bad {
    std::vector<std::string> arguments;
    int exit_code;
    std::string message;
  };
  const std::vector<Bad> bad = {
      {{}, 2, "bench: no command"},
      {{"ray"}, 2, "did you mean rays?"},
      {{"rays", "--triangles", "3"}, 2, "--triangles 3: must be a whole number from 36"},
      {{"rays", "--triangles", "36,"}, 2, "--triangles ''"},
      {{"rays", "--trangles", "36"}, 2, "did you mean --triangles?"},
      {{"rays", "--width", "3"}, 2, "--width 3"},
      {{"rays", "--out", "/proc/phlux"}, 5, "/proc/phlux"},
      {{"rays", "--out", "file"}, 5, "file"},
      {{"rays", "--device", "none such"}, 4, "none such"},
  };
  const TemporaryFolder folder;
  folder.write("file", "");
  for (const auto& [arguments, exit_code, message] : bad) {
    std::vector<std::string> all = {"bench"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run({all, folder.path(), {}, {}});
    CAPTURE(arguments, outcome.err);
    CHECK(outcome.exit_code == exit_code);
    CHECK(outcome.is_one_line_error());
    CHECK_THAT(outcome.err, Catch::Contains(message));
  }
}
