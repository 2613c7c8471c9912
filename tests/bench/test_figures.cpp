#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include <catch2/catch.hpp>

#include "bench/figures/figures.h"
#include "errors.h"
#include "temporary_folder.h"

using namespace phlux::bench;

namespace {

using Table = std::map<std::string, std::vector<double>>;

Table read(const TemporaryFolder& folder, int figure) {
  std::istringstream text(TemporaryFolder::read(folder / ("figure-" + std::to_string(figure) + ".csv")));
  std::string line, value;
  std::getline(text, line);
  std::vector<std::string> names;
  for (std::istringstream columns(line); std::getline(columns, value, ',');) names.push_back(value);
  Table table;
  while (std::getline(text, line)) {
    std::istringstream columns(line);
    for (const std::string& name : names) {
      std::getline(columns, value, ',');
      table[name].push_back(std::stod(value));
    }
  }
  return table;
}

const TemporaryFolder& figures(FigureSums* sums = nullptr) {
  static const TemporaryFolder folder;
  static const FigureSums written = [] {
    FiguresOptions options;
    options.folder = folder.path();
    return write_figure_tables(options);
  }();
  if (sums != nullptr) *sums = written;
  return folder;
}

// The trapezoidal rule over a grid of `rows` x `columns` values, first parameter slowest.
double integral(const std::vector<double>& values, std::size_t rows, std::size_t columns, double area) {
  double sum = 0;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) {
      const double edge = (i == 0 || i == rows - 1 ? 0.5 : 1) * (j == 0 || j == columns - 1 ? 0.5 : 1);
      sum += edge * values[i * columns + j];
    }
  return sum * area / static_cast<double>((rows - 1) * (columns - 1));
}

} // namespace

TEST_CASE("Figure 1: the lobe's height above the diffuse part") {
  const Table table = read(figures(), 1);
  const double peak = .4 / std::numbers::pi + .05 * 52 / (2 * std::numbers::pi);
  std::size_t mirrored = 0;
  for (std::size_t i = 0; i < table.at("f_r").size(); ++i)
    if (table.at("incoming_degrees")[i] == table.at("outgoing_degrees")[i]) {
      CHECK(table.at("f_r")[i] == Approx(peak).epsilon(1e-5));
      ++mirrored;
    }
  CHECK(mirrored == 6);
}

TEST_CASE("Figures 2 to 5: each integrand integrates to the reflectivity") {
  FigureSums sums;
  const TemporaryFolder& folder = figures(&sums);
  constexpr double pi = std::numbers::pi;
  CHECK(sums.exact == Approx(.4 + .05 * std::cos(pi / 6)).epsilon(1e-6));
  for (const auto& [figure, area] : std::map<int, double>{{2, pi * pi}, {3, 2 * pi}, {4, 1}})
    CHECK(integral(read(folder, figure)["integrand"], 49, 97, area) == Approx(sums.exact).epsilon(2e-3));
  const Table disk = read(folder, 5);
  double sum = 0;
  for (const double value : disk.at("integrand")) sum += value * std::pow(2.0 / 96, 2);
  CHECK(sum == Approx(sums.exact).epsilon(5e-3)); // squares at the edge are included whole or not at all
  for (const int figure : {2, 3, 4, 5}) {
    const Table table = read(folder, figure);
    for (std::size_t i = 0; i < table.at("f_r").size(); ++i) {
      const double length =
          std::hypot(table.at("direction_x")[i], table.at("direction_y")[i], table.at("direction_z")[i]);
      REQUIRE(length == Approx(1).epsilon(2e-6));
    }
  }
}

TEST_CASE("Figures 6 and 7: the squares sum to the reflectivity") {
  FigureSums sums;
  const TemporaryFolder& folder = figures(&sums);
  const double sampled_error = std::sqrt(sums.exact * (1 - sums.exact) / 100'000);
  CHECK(std::abs(sums.sampled - sums.exact) < 4 * sampled_error);
  // Ten points each; only the hundred squares at the edge have errors, of up to half a square each.
  const double rim_error = std::sqrt(100.0 * 0.25 / 10) * 4 / (25 * 25) * .4 / std::numbers::pi;
  CHECK(std::abs(sums.evaluated - sums.exact) < 4 * rim_error);
  for (const int figure : {6, 7}) {
    const Table table = read(folder, figure);
    double sum = 0;
    std::size_t largest = 0;
    const auto& values = table.at("partial_reflectivity");
    REQUIRE(values.size() == 25 * 25);
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum += values[i];
      if (values[i] > values[largest]) largest = i;
    }
    CHECK(sum == Approx(figure == 6 ? sums.sampled : sums.evaluated).epsilon(1e-5));
    CHECK(std::hypot(table.at("x")[largest] + .5, table.at("y")[largest]) < 0.15); // light comes from (.5, 0)
  }
}

TEST_CASE("Figures need a folder that can be written") {
  FiguresOptions options;
  options.folder = "/proc/phlux";
  CHECK_THROWS_AS(write_figure_tables(options), phlux::WriteError);
}
