#include <catch2/catch.hpp>

#include "cli/bench_tables.h"
#include "temporary_folder.h"

namespace {

// Small images, half a second for each cell.
std::vector<std::string> stability_command(const std::vector<std::string>& cells,
                                           const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"bench",     "stability", "--quick", "--side", "8",
                                        "--seconds", "0.5",       "--out",   "out"};
  for (const std::string& cell : cells) arguments.insert(arguments.end(), {"--cell", cell});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

} // namespace

TEST_CASE("phlux bench stability writes a row for each cell and method, charts and a section of the report") {
  const TemporaryFolder folder;
  const Outcome outcome =
      run({stability_command({"1,.3", "100,.0001"}, {"--method", "path none", "--method", "path light"}),
           folder.path(),
           {},
           {}});
  CAPTURE(outcome.err, outcome.out);
  const auto lines = lines_of(TemporaryFolder::read(folder / "out/stability.csv"));
  REQUIRE(lines.size() == 1 + 2 * 2);
  CHECK_THAT(lines[0], Catch::StartsWith("exponent,light_radius,") && Catch::EndsWith(",lanes,settings"));
  CHECK_THAT(lines[0], Catch::Contains(method_columns));
  const auto columns = split(lines[0]);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    CHECK(columns_of(lines[i]) == columns_of(lines[0]));
    CHECK(value_of(lines[i], columns, "reference_by") == "bidir balance");
    CHECK(std::stod(value_of(lines[i], columns, "reference_relmse")) > 0);
    CHECK(std::stod(value_of(lines[i], columns, "processor_seconds_per_sample")) > 0);
    CHECK(value_of(lines[i], columns, "variance_times_seconds").empty() ==
          (value_of(lines[i], columns, "verdict") != "sound"));
  }
  CHECK_THAT(lines[1], Catch::StartsWith("1,0.3,path,exact,none,"));
  CHECK_THAT(lines[3], Catch::StartsWith("100,0.0001,path,exact,none,"));
  CHECK(value_of(lines[3], columns, "verdict") ==
        "suspect"); // sampled directions do not hit such a small light
  CHECK_THAT(outcome.out, Catch::Contains("n 100, light radius 0.0001: too little time to tell"));
  if (!has_charts(outcome)) return;
  CHECK_THAT(TemporaryFolder::read(folder / "out/index.html"), Catch::Contains("Where methods fail"));
  for (const char* chart : {"best", "cost", "scene"}) {
    const std::string name = folder / (std::string("out/stability-") + chart);
    CHECK_THAT(TemporaryFolder::read(name + ".svg"), Catch::Contains("prefers-color-scheme:dark"));
    CHECK_THAT(TemporaryFolder::read(name + ".png"), Catch::StartsWith("\x89PNG"));
    CHECK_THAT(TemporaryFolder::read(name + "-dark.png"), Catch::StartsWith("\x89PNG"));
  }
}

TEST_CASE("phlux bench stability resumes where it was interrupted") {
  const TemporaryFolder folder;
  const auto environment = without_matplotlib(folder);
  const auto rows = [&] { return lines_of(TemporaryFolder::read(folder / "out/stability.csv")); };
  const std::vector<std::string> fast = {"--method", "path light"};
  (void)run({stability_command({"10,.1"}, fast), folder.path(), environment, {}});
  const auto first = rows();
  REQUIRE(first.size() == 2);

  std::vector<std::string> both = stability_command({"10,.1", "10,.01"}, fast);
  const Outcome stopped = run({both, folder.path(), environment, std::chrono::milliseconds(100)});
  CAPTURE(stopped.err, stopped.out);
  CHECK(stopped.exit_code == 130);
  CHECK(rows() == first);

  const Outcome whole = run({both, folder.path(), environment, {}});
  CHECK_THAT(whole.out, Catch::Contains("1 of 2 cells are measured already"));
  REQUIRE(rows().size() == 3);
  CHECK(rows()[1] == first[1]);

  // The rows of an added method join the others; another seed is a new measurement.
  (void)run({stability_command({"10,.1"}, {"--method", "path none"}), folder.path(), environment, {}});
  CHECK(rows().size() == 4);
  (void)run({stability_command({"10,.1"}, {"--method", "path light", "--seed", "2"}),
             folder.path(),
             environment,
             {}});
  REQUIRE(rows().size() == 3); // and the row of the other cell
  CHECK(rows()[2] != first[1]);
}
