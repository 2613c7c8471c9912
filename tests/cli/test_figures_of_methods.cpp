// The figures in the pages on rendering methods are those of their tables.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "cli/page_text.h"
#include "cli/saved_tables.h"

using namespace phlux::test;

namespace {

// By scene and method. Ratios are times relative to the best method, and NaN where none is known.
struct SceneTimes {
  std::map<std::string, std::map<std::string, double>> ratios, seconds, variances;

  SceneTimes() {
    const SavedTable table = saved("scenes.csv");
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      const std::string &scene = table.at(row, "scene"), method = table.method(row);
      ratios[scene][method] = table.number(row, "cost_ratio");
      seconds[scene][method] = table.number(row, "processor_seconds_per_sample");
      variances[scene][method] = table.number(row, "variance_measured");
    }
  }
  [[nodiscard]] double ratio(const std::string& scene, const std::string& method) const {
    return ratios.at(scene).at(method);
  }
};

} // namespace

TEST_CASE("Times in the report of scenes are those of its table") {
  const std::vector<std::string> methods = {"path none",     "path light",  "path mis",     "light",
                                            "bidir balance", "bidir power", "bidir uniform"};
  const SceneTimes table;
  CHECK(table.ratios.size() == 14);
  for (const auto& [scene, of_methods] : table.ratios) {
    if (scene == "glass-caustic") continue; // has no row: no method is known to be sound
    const std::vector<std::string> cells = row_of("saved/REPORT.md", scene);
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const double given = number_in(cells.at(i + 2));
      CAPTURE(scene, methods[i], given);
      if (std::isnan(table.ratio(scene, methods[i])))
        CHECK((cells[i + 2] == "refused" || cells[i + 2] == "biased"));
      else
        CHECK(given == Approx(table.ratio(scene, methods[i])).epsilon(0.025)); // two digits or more
    }
  }
}

TEST_CASE("What the pages say of methods is in the table of scenes") {
  const SceneTimes table;
  double path = 0.0, bidir = 0.0;
  for (const auto& [scene, ratios] : table.ratios) {
    if (scene.starts_with("furnace")) continue; // everything emits there
    bidir = std::fmax(bidir, ratios.at("bidir balance"));
    if (scene != "caustic") path = std::fmax(path, ratios.at("path mis"));
  }
  const double caustic = table.ratio("caustic", "path mis");
  const double variance =
      table.variances.at("caustic").at("path mis") / table.variances.at("caustic").at("bidir balance");
  const double cost =
      table.seconds.at("caustic").at("bidir balance") / table.seconds.at("caustic").at("path mis");
  CHECK(stated("README.md", "it takes at most # times as long to the same error as the best method") ==
        about(bidir));
  CHECK(stated("README.md", "on a caustic a #th of the time of") == about(caustic));
  CHECK(stated("bench/CHOOSING.md", "`path` takes at most # times as long") == about(path));
  CHECK(stated("bench/CHOOSING.md", "except the caustic, where it takes # times") == about(caustic));
  CHECK(stated("bench/CHOOSING.md", "`bidir` takes at most # times as long as the best") == about(bidir));
  CHECK(stated("bench/CHOOSING.md", "On `scenes/caustic.xml` its variance is # times lower") ==
        about(variance));
  CHECK(cost == Approx(4).epsilon(0.1)); // "the time of about four of `path`"
  CHECK(stated("bench/saved/REPORT.md", "It is # times as fast as `path mis` on caustic") == about(caustic));
  CHECK(stated("bench/saved/REPORT.md", "takes at most # times as long as the best on the others") ==
        about(bidir));
  const SavedTable scenes = saved("scenes.csv");
  const auto unbiased = [&](std::size_t row) { return scenes.at(row, "verdict") != "biased"; };
  CHECK(stated("bench/saved/REPORT.md", "the largest deviation from the reference is # standard errors") ==
        about(largest(scenes, "mean_bias_sigma", unbiased)));
}

TEST_CASE("Counts in the report of stability are those of its table") {
  const SavedTable table = saved("stability.csv");
  std::map<std::string, std::array<int, 3>> sound;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (table.at(row, "verdict") != "sound") continue;
    const double exponent = table.number(row, "exponent");
    auto& counts = sound[table.method(row)];
    ++counts[0];
    counts[1] += exponent <= 100 ? 1 : 0;
    counts[2] += exponent >= 1000 ? 1 : 0;
  }
  CHECK(sound.size() == 7);
  for (const auto& [method, counts] : sound) {
    const std::vector<std::string> cells = row_of("saved/STABILITY.md", method);
    CAPTURE(method);
    for (std::size_t i = 0; i < counts.size(); ++i) CHECK(number_in(cells.at(i + 2)) == counts[i]);
  }
}

TEST_CASE("Times in the report of stability are those of its table") {
  const SavedTable table = saved("stability.csv");
  std::map<std::string, std::map<std::string, double>> cells; // those of sound methods, by cell
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (table.at(row, "verdict") == "sound")
      cells[table.at(row, "exponent") + " " + table.at(row, "light_radius")][table.method(row)] =
          table.number(row, "variance_measured") * table.number(row, "processor_seconds_per_sample");
  std::map<std::string, double> most;
  for (const auto& [cell, methods] : cells) {
    const double best =
        std::ranges::min_element(methods, {}, [](const auto& each) { return each.second; })->second;
    for (const auto& [method, time] : methods) most[method] = std::max(most[method], time / best);
  }
  for (const auto& [method, ratio] : most) {
    const std::vector<std::string> range =
        split(split(row_of("saved/STABILITY.md", method).at(5), ";")[0], " to ");
    CAPTURE(method);
    CHECK(number_in(replaced(range.at(1), ",", "")) == about(ratio));
  }
  const auto sound = [&](std::size_t row) { return table.at(row, "verdict") == "sound"; };
  CHECK(stated("bench/saved/STABILITY.md", "deviate from the reference by at most # standard errors") ==
        about(largest(table, "mean_bias_sigma", sound)));
}
