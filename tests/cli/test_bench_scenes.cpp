#include <algorithm>
#include <regex>

#include <catch2/catch.hpp>

#include "cli/bench_tables.h"
#include "temporary_folder.h"

namespace {

// bench scenes with small images, one second for each scene.
std::vector<std::string> scenes_command(const std::vector<std::string>& names,
                                        const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"bench",     "scenes", "--quick", "--side", "8",
                                        "--seconds", "1",      "--out",   "out"};
  for (const std::string& name : names)
    arguments.insert(arguments.end(), {"--scene", std::filesystem::exists(name) ? name : shipped(name)});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

} // namespace

TEST_CASE("phlux bench scenes writes the contract's columns, a row for each method, charts and a report") {
  const TemporaryFolder folder;
  const Outcome outcome = run({scenes_command({"furnace-sphere", "point-light"}), folder.path(), {}, {}});
  CAPTURE(outcome.err, outcome.out);
  const auto lines = lines_of(TemporaryFolder::read(folder / "out/scenes.csv"));
  REQUIRE(lines.size() == 1 + 2 * 5);
  CHECK_THAT(lines[0], Catch::StartsWith(std::string("scene") + method_columns));
  const auto columns = split(lines[0]);
  int sound = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    CHECK(columns_of(lines[i]) == columns_of(lines[0]));
    const auto value = [&](const std::string& name) { return value_of(lines[i], columns, name); };
    const std::string verdict = value("verdict");
    if (verdict == "refused") {
      CHECK_FALSE(value("reason").empty());
      CHECK(value("variance_per_sample").empty());
      CHECK(value("seconds").empty());
    } else {
      CHECK(std::stod(value("variance_measured")) > 0);
      CHECK(std::stod(value("seconds_per_sample")) > 0);
      CHECK(std::stoi(value("rounds")) >= 5);
    }
    if (verdict == "sound") {
      ++sound;
      CHECK(std::stod(value("variance_times_seconds")) ==
            Approx(std::stod(value("variance_per_sample")) * std::stod(value("seconds_per_sample")))
                .epsilon(1e-4));
      CHECK(std::stod(value("top_share")) < 1);
    } else {
      CHECK(value("variance_times_seconds").empty());
    }
  }
  CHECK(sound >= 1);
  CHECK_THAT(outcome.out, Catch::Contains("furnace-sphere: ") && Catch::Contains("all intervals are right"));
  const auto answers = lines_of(TemporaryFolder::read(folder / "out/scenes.verdict.txt"));
  REQUIRE(answers.size() == 2);
  CHECK_THAT(answers[0], Catch::StartsWith("furnace-sphere: "));
  for (const std::string& answer : answers) CHECK_THAT(outcome.out, Catch::Contains(answer + "\n"));
  CHECK_THAT(lines[6], Catch::StartsWith("point-light,path,exact,none,"));
  CHECK(value_of(lines[6], columns, "verdict") == "refused"); // no path hits a point light
  const auto points = lines_of(TemporaryFolder::read(folder / "out/scenes-convergence.csv"));
  CHECK(points.size() > 5);
  CHECK(points[0] ==
        "scene,integrator,strategy,connect_or_weights,seconds,samples_per_pixel,relmse,relmse_least,"
        "relmse_most,relmse_expected,rounds,settings");
  for (const std::string& line : points) CHECK(columns_of(line) == columns_of(points[0]));
  CHECK(std::filesystem::exists(folder / "out/references/furnace-sphere.exr"));
  if (!has_charts(outcome)) return;
  const std::string html =
      std::regex_replace(TemporaryFolder::read(folder / "out/index.html"), std::regex("</?code>"), "");
  CHECK_THAT(html, Catch::Contains("point-light: speed and accuracy") && Catch::Contains("</svg>"));
  for (const std::string& answer : answers) CHECK_THAT(html, Catch::Contains("<p>" + answer + "</p>"));
  for (const char* chart : {"overview", "furnace-sphere-convergence", "furnace-sphere-efficiency",
                            "furnace-sphere-times", "furnace-sphere-images", "furnace-sphere-errors"}) {
    const std::string name = std::string("out/scenes-") + chart;
    CHECK_THAT(TemporaryFolder::read(folder / (name + ".svg")), Catch::Contains("prefers-color-scheme:dark"));
    CHECK_THAT(TemporaryFolder::read(folder / (name + ".png")), Catch::StartsWith("\x89PNG"));
    CHECK_THAT(TemporaryFolder::read(folder / (name + "-dark.png")), Catch::StartsWith("\x89PNG"));
  }
}

TEST_CASE("phlux bench scenes resumes where it was interrupted") {
  const TemporaryFolder folder;
  const auto environment = without_matplotlib(folder);
  const auto rows_of = [&](const std::string& scene) {
    std::vector<std::string> rows;
    for (const std::string& line : lines_of(TemporaryFolder::read(folder / "out/scenes.csv")))
      if (line.starts_with(scene + ",")) rows.push_back(line);
    return rows;
  };
  (void)run({scenes_command({"furnace-sphere"}), folder.path(), environment, {}});
  const auto first = rows_of("furnace-sphere");
  REQUIRE(first.size() == 5);

  const auto both = scenes_command({"furnace-sphere", "cornell-box"});
  const Outcome stopped = run({both, folder.path(), environment, std::chrono::milliseconds(300)});
  CAPTURE(stopped.err, stopped.out);
  CHECK(stopped.exit_code == 130);
  CHECK(rows_of("furnace-sphere") == first);
  CHECK(rows_of("cornell-box").empty());

  const Outcome whole = run({both, folder.path(), environment, {}});
  CHECK_THAT(whole.out, Catch::Contains("furnace-sphere: measured already"));
  CHECK(rows_of("furnace-sphere") == first);
  const auto second = rows_of("cornell-box");
  CHECK(second.size() == 5);

  // Another seed is a new measurement; the rows of the other scene stay.
  (void)run({scenes_command({"furnace-sphere"}, {"--seed", "2"}), folder.path(), environment, {}});
  CHECK(rows_of("furnace-sphere").size() == 5);
  CHECK(rows_of("furnace-sphere") != first);
  CHECK(rows_of("cornell-box") == second);
}

TEST_CASE("phlux bench scenes measures earlier strategies again with an added one") {
  const TemporaryFolder folder;
  const auto environment = without_matplotlib(folder);
  (void)run({scenes_command({"furnace-sphere"}), folder.path(), environment, {}});
  CHECK(lines_of(TemporaryFolder::read(folder / "out/scenes.csv")).size() == 1 + 5);
  (void)run({scenes_command({"furnace-sphere"}, {"--strategy", "lobe-ks"}), folder.path(), environment, {}});
  const auto after = lines_of(TemporaryFolder::read(folder / "out/scenes.csv"));
  CHECK(after.size() == 1 + 10);
  CHECK(std::ranges::count_if(after, [&](const std::string& line) {
          return value_of(line, split(after[0]), "rank") == "best";
        }) <= 1);
}
