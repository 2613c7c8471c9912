// The figures in the pages are those of the tables beside them.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "cli/page_text.h"

using namespace phlux::test;

namespace {

struct Table {
  std::vector<std::vector<std::string>> rows;
  std::map<std::string, std::size_t> columns;

  [[nodiscard]] const std::string& at(std::size_t row, const std::string& column) const {
    return rows[row].at(columns.at(column));
  }
  [[nodiscard]] double number(std::size_t row, const std::string& column) const {
    return at(row, column).empty() ? NAN : std::stod(at(row, column));
  }
  [[nodiscard]] std::string method(std::size_t row) const {
    return trimmed(replaced(at(row, "integrator") + " " + at(row, "connect_or_weights"), " -", ""));
  }
};

std::vector<std::string> cells_of_csv(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

Table saved(const std::string& name) {
  Table table;
  for (const std::string& line : lines_of(source / "bench/saved" / name))
    table.rows.push_back(cells_of_csv(line));
  for (std::size_t i = 0; i < table.rows[0].size(); ++i) table.columns[table.rows[0][i]] = i;
  table.rows.erase(table.rows.begin());
  return table;
}

// The cells of the row of a page's table that begins with `first`.
std::vector<std::string> row_of(const std::string& page, const std::string& first) {
  for (const std::string& line : lines_of(source / "bench" / page)) {
    if (!line.starts_with("| " + first + " |")) continue;
    std::vector<std::string> cells;
    for (const std::string& cell : split(line, "|")) cells.push_back(trimmed(cell));
    return cells;
  }
  FAIL(page << " has no row " << first);
  return {};
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

double number_in(const std::string& cell) {
  std::string digits;
  for (const char c : cell)
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.')
      digits += c;
    else if (c == ' ' && !digits.empty())
      break;
  return digits.empty() ? NAN : std::stod(digits);
}

// The number in place of the only # of a sentence of a page of bench/, whose lines may break anywhere.
double stated(const std::string& page, const std::string& sentence) {
  std::string text;
  for (const std::string& line : lines_of(source / page)) text += trimmed(line) + " ";
  const std::vector<std::string> parts = split(sentence, "#");
  for (std::size_t at = text.find(parts.at(0)); at != std::string::npos; at = text.find(parts[0], at + 1)) {
    const std::size_t begin = at + parts[0].size();
    std::size_t end = std::min(text.find_first_not_of("0123456789.,e-", begin), text.size());
    while (end > begin && std::isdigit(static_cast<unsigned char>(text[end - 1])) == 0) --end;
    if (text.substr(end).starts_with(parts.at(1)) && end > begin)
      return std::stod(replaced(text.substr(begin, end - begin), ",", ""));
  }
  FAIL(page << " has no sentence \"" << sentence << '"');
  return NAN;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

// Time to unit variance, processor time.
double time_of(const Table& table, std::size_t row) {
  return table.number(row, "variance_measured") * table.number(row, "processor_seconds_per_sample");
}

// By scene and method.
struct SceneTimes {
  std::map<std::string, std::map<std::string, double>> times, seconds, variances;
  std::map<std::string, double> best; // of the sound methods

  SceneTimes() {
    const Table table = saved("scenes.csv");
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      const std::string& scene = table.at(row, "scene");
      const double time = time_of(table, row);
      times[scene][table.method(row)] = time;
      seconds[scene][table.method(row)] = table.number(row, "processor_seconds_per_sample");
      variances[scene][table.method(row)] = table.number(row, "variance_measured");
      if (table.at(row, "verdict") != "sound") continue;
      best[scene] = best.contains(scene) ? std::min(best[scene], time) : time;
    }
  }
  // The time of a method over the best of the scene.
  [[nodiscard]] double ratio(const std::string& scene, const std::string& method) const {
    return times.at(scene).at(method) / best.at(scene);
  }
};

const std::vector<std::string> scenes_with_lamps = {"caustic", "cornell-box", "glossy-box",
                                                    "mesh",    "point-light", "two-phong-spheres"};

// A number in a page, rounded to two digits or to a bound.
Approx about(double value) {
  return Approx(value).epsilon(0.05);
}

// The largest absolute value of a column in the rows that `chosen` selects.
template<typename Chosen>
double largest(const Table& table, const std::string& column, const Chosen& chosen) {
  double most = 0.0;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (const double value = std::abs(table.number(row, column)); chosen(row) && value > most) most = value;
  return most;
}

} // namespace

TEST_CASE("Times in the report of scenes are those of its table") {
  const std::vector<std::string> methods = {"path none",     "path light",  "path mis",     "light",
                                            "bidir balance", "bidir power", "bidir uniform"};
  const SceneTimes table;
  CHECK(table.times.size() == 8);
  for (const auto& [scene, of_methods] : table.times) {
    const std::vector<std::string> cells = row_of("saved/REPORT.md", scene);
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const double given = number_in(cells.at(i + 2));
      if (std::isnan(given)) continue; // refused
      CAPTURE(scene, methods[i]);
      CHECK(given == Approx(table.ratio(scene, methods[i])).epsilon(0.025)); // two digits or more
    }
  }
}

TEST_CASE("What the pages say of methods is in the table of scenes") {
  const SceneTimes table;
  double path = 0.0, bidir = 0.0;
  for (const std::string& scene : scenes_with_lamps) {
    bidir = std::max(bidir, table.ratio(scene, "bidir balance"));
    if (scene != "caustic") path = std::max(path, table.ratio(scene, "path mis"));
  }
  const double caustic = table.ratio("caustic", "path mis");
  const double variance =
      table.variances.at("caustic").at("path mis") / table.variances.at("caustic").at("bidir balance");
  const double cost =
      table.seconds.at("caustic").at("bidir balance") / table.seconds.at("caustic").at("path mis");
  CHECK(
      stated("README.md", "at most # times as long as the best method on every measured scene with lamps") ==
      about(bidir));
  CHECK(stated("README.md", "a #th of the time of `path` on a caustic") == about(caustic));
  CHECK(stated("bench/CHOOSING.md", "`path` takes at most # times as long") == about(path));
  CHECK(stated("bench/CHOOSING.md", "except the caustic, where it takes # times") == about(caustic));
  CHECK(stated("bench/CHOOSING.md", "`bidir` takes at most # times as long as the best") == about(bidir));
  CHECK(stated("bench/CHOOSING.md", "On `scenes/caustic.xml` its variance is # times lower") ==
        about(variance));
  CHECK(cost == Approx(4).epsilon(0.1)); // "the time of about four of `path`"
  CHECK(stated("bench/saved/REPORT.md", "It is # times as fast as `path mis` on caustic") == about(caustic));
  CHECK(stated("bench/saved/REPORT.md", "takes at most # times as long as the best on the other two") ==
        about(bidir));
  const auto always = [](std::size_t) { return true; };
  CHECK(stated("bench/saved/REPORT.md", "the largest deviation from the reference is # standard errors") ==
        about(largest(saved("scenes.csv"), "mean_bias_sigma", always)));
}

TEST_CASE("Counts in the report of stability are those of its table") {
  const Table table = saved("stability.csv");
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

TEST_CASE("Means in the pages on roulette are those of the table") {
  const Table table = saved("roulette.csv");
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
  const Table table = saved("roulette-strategies.csv");
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
  const Table table = saved("samplers.csv");
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

TEST_CASE("Times in the report of stability are those of its table") {
  const Table table = saved("stability.csv");
  std::map<std::string, std::map<std::string, double>> cells; // those of sound methods, by cell
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (table.at(row, "verdict") == "sound")
      cells[table.at(row, "exponent") + " " + table.at(row, "light_radius")][table.method(row)] =
          time_of(table, row);
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

TEST_CASE("Speed and errors in the page on precision are those of its table") {
  const Table table = saved("precision.csv");
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
  CHECK(stated(page, "times as fast as in float64 (median #)") == about(median(speeds("path", "16"))));
  CHECK(stated(page, "times (#), and `bidir`") == about(median(speeds("light", "16"))));
  CHECK(stated(page, "times (#). For every integrator") == about(median(speeds("bidir", "16"))));
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
  const Table table = saved("remedies.csv");
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
  CHECK(stated(page, "and # to 3.3 with 64") == about(gains("light-selection", "64 lights").front()));
  CHECK(stated(page, "to # with 64") == about(gains("light-selection", "64 lights").back()));
  CHECK(stated(page, "With 262,144 lamps it is # for `path light`") ==
        about(gains("light-selection", "262144 lights").back()));
  CHECK(stated(page, "and # for `path mis`") == about(gains("light-selection", "262144 lights").front()));
  CHECK(stated(page, "the default) has a gain of # to") == about(gains("connections", "").front()));
  CHECK(stated(page, "to # in each cell of `bench stability`") == about(gains("connections", "").back()));
}

TEST_CASE("Counts and times in the page on sampling are those of its tables") {
  const Table ranking = saved("sampling.ranking.csv"), times = saved("sampling.csv");
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
  CHECK(stated(page, "is the best in 13 and tied in # of 39 cases") == count("lobe-ks", "tied", "1"));
  CHECK(stated(page, "of 39 cases, and takes at most # times as long") == about(worst("lobe-ks", "1")));
  double unbiased = 0.0, printed = 0.0, rows = 0.0;
  for (const Table& table : {times, saved("sampling-no-roulette.csv")}) {
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
  CHECK(stated(page, "in the # rows of both tables") == rows);
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
    return median(ratios);
  };
  CHECK(stated(page, "A sample of `exact` takes # times as long") == about(ratio("exact")));
  CHECK(stated(page, "of `lobe-estimate` # times, of") == about(ratio("lobe-estimate")));
  CHECK(stated(page, "of `rejection` # times") == about(ratio("rejection")));
}

TEST_CASE("Errors and times of formulas in the page on sampling are those of the table") {
  const Table table = saved("arithmetic.csv");
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
  CHECK(stated(page, "It takes # ns, `pow`") == about(median(values(lobe, "ns_per_value"))));
  CHECK(stated(page, "`pow` # ns.") == about(median(values("dot^n by pow", "ns_per_value"))));
  CHECK(stated(page, "of at most # ulp") == about(std::ranges::max(values(sine, "largest_ulp"))));
  CHECK(stated(page, "the power takes # ns") ==
        about(median(values(lobe + " by own log1p", "ns_per_value"))));
  CHECK(stated(page, "instead of # ns") == about(median(values(sine, "ns_per_value"))));
  CHECK(stated(page, "with a fixed offset of 1/1000, # points are") ==
        values("fixed: 1/1000", "failed").front());
}
