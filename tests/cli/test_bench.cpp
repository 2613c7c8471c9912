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
  if (outcome.err.find("python3-matplotlib") != std::string::npos) {
    WARN("no matplotlib: the charts are not tested");
    CHECK(outcome.exit_code == 5);
  } else {
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(TemporaryFolder::read(folder / "out/new/index.html"), Catch::Contains("Rays against Embree"));
    CHECK_THAT(TemporaryFolder::read(folder / "out/new/rays-rates.svg"), Catch::Contains("</svg>"));
  }
  const auto lines = lines_of(TemporaryFolder::read(folder / "out/new/rays.csv"));
  REQUIRE(lines.size() == 7);
  CHECK_THAT(lines[0],
             Catch::StartsWith("scene,triangles,kind,device,layout,mrays_per_s,embree_mrays_per_s,ratio"));
  for (const std::string& line : lines) CHECK(columns_of(line) == columns_of(lines[0]));
  for (const char* kind : {",camera,", ",bounce,", ",shadow,"})
    CHECK_THAT(outcome.out, Catch::Contains(kind));
}

TEST_CASE("phlux bench sampling writes the contract's columns, a row for each strategy and case") {
  const TemporaryFolder folder;
  const Outcome outcome = run({{"bench", "sampling", "--out", ".", "--samples", "1000", "--strategy", "exact",
                                "--strategy", "rejection", "--case", ".4,.05,50,30", "--case", "0,1,1e6,89"},
                               folder.path(),
                               {},
                               {}});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  const auto lines = lines_of(TemporaryFolder::read(folder / "sampling.csv"));
  REQUIRE(lines.size() == 4); // rejection would need too many proposals in the second case
  CHECK_THAT(lines[0], Catch::StartsWith("strategy,kd,ks,n,theta_deg,samples,mean,exact,bias_sigma,variance,"
                                         "variance_standard_error,rays_per_sample,ns_per_sample,"
                                         "variance_times_cost"));
  CHECK_THAT(lines[1], Catch::StartsWith("exact,0.4,0.05,50,30,"));
  CHECK_THAT(lines[2], Catch::StartsWith("rejection,0.4,0.05,50,30,"));
  CHECK_THAT(lines[3], Catch::StartsWith("exact,0,1,1000000,89,"));
  for (const std::string& line : lines) CHECK(columns_of(line) == columns_of(lines[0]));
  CHECK_THAT(outcome.out, Catch::Contains("rejection is left out of 1 cases"));
}

TEST_CASE("phlux bench figures draws the seven figures of CW 197") {
  const TemporaryFolder folder;
  const Outcome outcome = run({{"bench", "figures", "--out", "a folder"}, folder.path(), {}, {}});
  CAPTURE(outcome.err);
  for (int figure = 1; figure <= 7; ++figure)
    CHECK(std::filesystem::exists(folder / ("a folder/figure-" + std::to_string(figure) + ".csv")));
  CHECK_THAT(outcome.out, Catch::Contains("reflectivity 0.44330"));
  if (outcome.err.find("python3-matplotlib") != std::string::npos) {
    WARN("no matplotlib: the drawings are not tested");
    return;
  }
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  for (int figure = 1; figure <= 7; ++figure) {
    const std::string name = "a folder/figure-" + std::to_string(figure);
    CHECK_THAT(TemporaryFolder::read(folder / (name + ".png")), Catch::StartsWith("\x89PNG"));
    CHECK_THAT(TemporaryFolder::read(folder / (name + ".svg")), Catch::Contains("</svg>"));
  }
}

TEST_CASE("phlux bench figures without matplotlib keeps the tables and names the package") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "python");
  folder.write("python/matplotlib.py", "raise ImportError('not installed')\n");
  const Outcome outcome =
      run({{"bench", "figures", "--out", "out"}, folder.path(), {{"PYTHONPATH", folder / "python"}}, {}});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 5);
  CHECK(outcome.is_one_line_error());
  CHECK_THAT(outcome.err, Catch::Contains("python3-matplotlib"));
  CHECK(std::filesystem::exists(folder / "out/figure-7.csv"));
  CHECK_FALSE(std::filesystem::exists(folder / "out/figure-7.svg"));
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
      {{"sampling", "--strategy", "magic"}, 2, "--strategy magic: must be one of uniform"},
      {{"sampling", "--strategy", "exct"}, 2, "did you mean exact?"},
      {{"sampling", "--samples", "0"}, 2, "--samples 0"},
      {{"sampling", "--case", ".4,.05,50"}, 2, "must be KD,KS,N,DEGREES"},
      {{"sampling", "--case", ".4,.7,50,30"}, 2, "at most 1"},
      {{"sampling", "--case", ".4,.05,-1,30"}, 2, "--case -1: must be a number from 0 to"},
      {{"sampling", "--case", ".4,.05,50,90"}, 2, "--case 90"},
      {{"sampling", "--out", "/proc/phlux"}, 5, "/proc/phlux"},
      {{"sampling", "--device", "none such"}, 4, "none such"},
      {{"figures", "--out", "/proc/phlux"}, 5, "/proc/phlux"},
      {{"figures", "--out", "file"}, 5, "file"},
      {{"figures", "--device", "none such"}, 4, "none such"},
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
