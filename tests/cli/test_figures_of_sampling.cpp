// The figures in the pages on sampling, roulette, samplers, precision and remedies are those of their tables.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "cli/page_text.h"
#include "cli/saved_tables.h"
#include "measure/moments.h"

using namespace phlux;
using namespace phlux::test;

TEST_CASE("Means in the pages on roulette are those of the table") {
  const SavedTable table = saved("roulette.csv");
  std::map<std::string, std::vector<double>> ratios;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    ratios[table.at(row, "roulette") + table.at(row, "integrator") + table.at(row, "rr_depth")].push_back(
        table.number(row, "ratio"));
  const auto check = [&](const std::string& page, const std::string& name, std::size_t first) {
    const std::vector<std::string> cells = row_of(page, "`" + name + "`");
    std::size_t column = first;
    for (const char* integrator : {"bidir", "path"})
      for (const char* depth : {"5", "1"}) {
        CAPTURE(page, name, integrator, depth);
        CHECK(number_in(cells.at(column++)) ==
              Approx(geometric_mean(ratios.at(name + integrator + depth))).margin(6e-3));
      }
  };
  for (const char* name : {"kd-ks", "throughput", "efficiency"}) {
    check("saved/ROULETTE.md", name, 2);
    check("CHOOSING.md", name, 3);
  }
}

TEST_CASE("Means in the page on strategies in whole renders are those of the table") {
  const SavedTable table = saved("roulette-strategies.csv");
  std::map<std::string, std::map<std::string, std::vector<double>>> ratios; // by strategy, then column
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (table.at(row, "roulette") != "strategy" && table.at(row, "scene") != "caustic")
      ratios[table.at(row, "strategy")][table.at(row, "integrator") + table.at(row, "rr_depth")].push_back(
          table.number(row, "ratio"));
  CHECK(ratios.size() == 12);
  for (const auto& [strategy, columns] : ratios) {
    std::size_t column = 2;
    for (const char* integrator : {"path", "bidir", "light"})
      for (const char* depth : {"1", "5", "-1"}) {
        CAPTURE(strategy, integrator, depth);
        CHECK(number_in(row_of("saved/ROULETTE.md", "`" + strategy + "`").at(column++)) ==
              Approx(geometric_mean(columns.at(std::string(integrator) + depth))).epsilon(0.02));
      }
  }
}

TEST_CASE("Times in the pages on samplers are those of the table") {
  const SavedTable table = saved("samplers.csv");
  std::map<std::string, std::vector<double>> times; // of the scenes
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string sampler = table.at(row, "sampler"), integrator = table.at(row, "integrator");
    if (table.at(row, "samples_per_pixel") != "1024") continue;
    const double time = table.number(row, "relative_time");
    times[integrator + sampler].push_back(time);
    if (sampler == "independent") continue;
    const std::size_t column = (integrator == "path" ? 2 : 4) + (sampler == "lattice" ? 0 : 1);
    CAPTURE(table.at(row, "scene"), integrator, sampler);
    CHECK(number_in(row_of("saved/SAMPLERS.md", table.at(row, "scene")).at(column)) ==
          Approx(time).margin(6e-3));
  }
  CHECK(times.at("pathindependent").size() == 7);
  for (const char* sampler : {"lattice", "sobol"}) {
    std::size_t column = 3;
    for (const char* integrator : {"path", "bidir"})
      CHECK(number_in(row_of("CHOOSING.md", std::string("`") + sampler + "`").at(column++)) ==
            Approx(geometric_mean(times.at(std::string(integrator) + sampler))).margin(6e-3));
  }
}

TEST_CASE("Speed and errors in the page on precision are those of its table") {
  const SavedTable table = saved("precision.csv");
  const auto speeds = [&](const std::string& integrator, const std::string& width) {
    std::vector<double> values;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      if (table.at(row, "integrator") == integrator && table.at(row, "width") == width)
        values.push_back(table.number(row, "times_as_fast"));
    std::ranges::sort(values);
    return values;
  };
  const std::string page = "bench/saved/PRECISION.md";
  const std::map<std::string, std::string> sentences = {
      {"path", "`path` is # to"}, {"light", "`light` # to"}, {"bidir", "`bidir` # to"}};
  for (const auto& [integrator, sentence] : sentences) {
    const std::vector<double> wide = speeds(integrator, "16");
    CAPTURE(integrator);
    CHECK(stated(page, sentence) == about(wide.front()));
  }
  CHECK(stated(page, "times as fast as in float64 (median #)") ==
        about(measure::median(speeds("path", "16"))));
  CHECK(stated(page, "times (#), and `bidir`") == about(measure::median(speeds("light", "16"))));
  CHECK(stated(page, "times (#). The gain of `path`") == about(measure::median(speeds("bidir", "16"))));
  CHECK(stated(page, "differs from the same samples in float64 by at most # of its noise") ==
        Approx(largest(table, "difference", [&](std::size_t row) {
          return table.at(row, "scene") != "corridor";
        })).epsilon(0.1));
  CHECK(stated(page, "the relative difference is at most # (`mean_difference`)") ==
        about(largest(table, "mean_difference", [&](std::size_t row) {
          return std::abs(table.number(row, "mean_difference")) >
                 5 * table.number(row, "mean_difference_standard_error");
        })));
}

TEST_CASE("Gains in the page on remedies are those of its table") {
  const SavedTable table = saved("remedies.csv");
  const auto gains = [&](const std::string& remedy, const std::string& place) {
    std::map<std::string, double> of_methods;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      if (table.at(row, "remedy") == remedy && table.at(row, "place").starts_with(place))
        of_methods[table.method(row) + table.at(row, "place")] = table.number(row, "gain");
    std::vector<double> values;
    for (const auto& each : of_methods) values.push_back(each.second);
    std::ranges::sort(values);
    return values;
  };
  const std::string page = "bench/saved/REMEDIES.md";
  CHECK(stated(page, "The gain is # to") == about(gains("light-selection", "8 lights").front()));
  CHECK(stated(page, "to # with 8 lamps") == about(gains("light-selection", "8 lights").back()));
  CHECK(stated(page, "and # to 3.4 with 64") == about(gains("light-selection", "64 lights").front()));
  CHECK(stated(page, "to # with 64") == about(gains("light-selection", "64 lights").back()));
  CHECK(stated(page, "With 262,144 lamps it is # for `path light`") ==
        about(gains("light-selection", "262144 lights").back()));
  CHECK(stated(page, "and # for `path mis`") == about(gains("light-selection", "262144 lights").front()));
  CHECK(stated(page, "and its gain there is # +- 0.03 to") == about(gains("connections", "").front()));
  CHECK(stated(page, "+- 0.03 to # +- 0.05. It is for long paths") == about(gains("connections", "").back()));
}

TEST_CASE("Counts and times in the page on sampling are those of its tables") {
  const SavedTable ranking = saved("sampling.ranking.csv"), times = saved("sampling.csv");
  const std::string page = "bench/saved/SAMPLING.md";
  const auto count = [&](const std::string& strategy, const std::string& verdict,
                         const std::string& roulette) {
    int rows = 0;
    for (std::size_t row = 0; row < ranking.rows.size(); ++row)
      rows += ranking.at(row, "strategy") == strategy && ranking.at(row, "verdict") == verdict &&
                      ranking.at(row, "roulette") == roulette
                  ? 1
                  : 0;
    return rows;
  };
  const auto worst = [&](const std::string& strategy, const std::string& roulette) {
    return largest(ranking, "factor", [&](std::size_t row) {
      return ranking.at(row, "strategy") == strategy && ranking.at(row, "roulette") == roulette;
    });
  };
  CHECK(stated(page, "Of all 39 cases it is the best in # and tied") == count("exact", "best", "0"));
  CHECK(stated(page, "it is the best in 13 and tied in #, and") == count("exact", "tied", "0"));
  CHECK(stated(page, "and takes at most # times as long as the best to the same error; `lobe-ks`") ==
        about(worst("exact", "0")));
  CHECK(stated(page, "With roulette `lobe-ks` is the best in # and") == count("lobe-ks", "best", "1"));
  CHECK(stated(page, "is the best in 18 and tied in # of 39 cases") == count("lobe-ks", "tied", "1"));
  CHECK(stated(page, "of 39 cases, and takes at most # times as long") == about(worst("lobe-ks", "1")));
  double unbiased = 0.0, printed = 0.0, rows = 0.0;
  for (const SavedTable& table :
       {times, saved("sampling-no-roulette.csv"), saved("sampling-plain-roulette.csv")}) {
    const auto is_printed = [&](std::size_t row) {
      return table.at(row, "strategy") == "lobe-estimate-printed";
    };
    const auto counts = [&](std::size_t row) {
      return !is_printed(row) && table.at(row, "marks").find("unresolved") == std::string::npos;
    };
    for (std::size_t row = 0; row < table.rows.size(); ++row) rows += counts(row) ? 1 : 0;
    unbiased = std::max(unbiased, largest(table, "bias_sigma", counts));
    printed = std::max(printed, largest(table, "bias_sigma", is_printed));
  }
  CHECK(stated(page, "in the # rows of the three tables") == rows);
  CHECK(stated(page, "differs from the exact value by at most # standard errors") == about(unbiased));
  CHECK(stated(page, "differs by up to # standard errors") == about(printed));
  std::map<std::string, std::map<std::string, double>> cases; // nanoseconds by case and strategy
  for (std::size_t row = 0; row < times.rows.size(); ++row) {
    std::string name;
    for (const char* column : {"kd", "ks", "n", "theta_deg", "integrand", "roulette"})
      name += times.at(row, column) + " ";
    cases[name][times.at(row, "strategy")] = times.number(row, "ns_per_sample");
  }
  const auto ratio = [&](const std::string& strategy) {
    std::vector<double> ratios;
    for (const auto& [name, each] : cases)
      if (each.contains(strategy) && each.contains("lobe-ks"))
        ratios.push_back(each.at(strategy) / each.at("lobe-ks"));
    return measure::median(ratios);
  };
  CHECK(stated(page, "A sample of `exact` takes # times as long") == about(ratio("exact")));
  CHECK(stated(page, "of `lobe-estimate` # times, of") == about(ratio("lobe-estimate")));
  CHECK(stated(page, "of `rejection` # times") == about(ratio("rejection")));
}

TEST_CASE("Errors and times of formulas in the page on sampling are those of the table") {
  const SavedTable table = saved("arithmetic.csv");
  const std::string page = "bench/saved/SAMPLING.md";
  const auto values = [&](const std::string& formula, const std::string& column) {
    std::vector<double> all;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      if (table.at(row, "formula") == formula) all.push_back(table.number(row, column));
    REQUIRE(!all.empty());
    return all;
  };
  const std::string lobe = "exp(n log1p(-|a-b|²/2))", sine = "sqrt(-expm1(2 log(u)/(n+1)))";
  const std::vector<double> errors = values(lobe, "rms_relative");
  CHECK(stated(page, "its rms relative error is # to") == about(std::ranges::min(errors)));
  CHECK(stated(page, "to #, while") == about(std::ranges::max(errors)));
  CHECK(stated(page, "It takes # ns, `pow`") == about(measure::median(values(lobe, "ns_per_value"))));
  CHECK(stated(page, "`pow` # ns.") == about(measure::median(values("dot^n by pow", "ns_per_value"))));
  CHECK(stated(page, "of at most # ulp") == about(std::ranges::max(values(sine, "largest_ulp"))));
  CHECK(stated(page, "the power takes # ns") ==
        about(measure::median(values(lobe + " by own log1p", "ns_per_value"))));
  CHECK(stated(page, "instead of # ns") == about(measure::median(values(sine, "ns_per_value"))));
  CHECK(stated(page, "with a fixed offset of 1/1000, # points are") ==
        values("fixed: 1/1000", "failed").front());
}
