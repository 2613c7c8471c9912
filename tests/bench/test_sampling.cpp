// The tables of `phlux bench sampling`: rows, marks, and resuming an interrupted run.
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "bench/common/tables/saved_table.h"
#include "bench/sampling/sampling.h"
#include "bench/sampling/sampling_table.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::bench;

namespace {

SamplingOptions options_for(const TemporaryFolder& folder) {
  SamplingOptions options;
  options.folder = folder.path();
  options.samples = 1;
  return options;
}

using CsvRow = std::map<std::string, std::string>; // by column

std::vector<CsvRow> rows_of(const TemporaryFolder& folder, const std::string& name) {
  const SavedTable table(folder.path(), name, sampling_columns());
  std::vector<CsvRow> rows;
  for (const SavedTable::Row& row : table.rows()) {
    rows.emplace_back();
    for (const std::string& column : sampling_columns()) rows.back()[column] = table.value(row, column);
  }
  return rows;
}

CsvRow row_of(const std::vector<CsvRow>& rows, const std::string& strategy, const std::string& light) {
  for (CsvRow row : rows)
    if (row["strategy"] == strategy && row["integrand"] == light) return row;
  FAIL("no row of " << strategy << " and " << light);
  return {};
}

double number(CsvRow row, const std::string& column) {
  return std::stod(row[column]);
}

} // namespace

TEST_CASE("The loss of the printed estimate agrees with known values") {
  CHECK(printed_loss({0, 1, 50, 85}) == Approx(.27).margin(.005));
  CHECK(printed_loss({0, 1, 50, 80}) == Approx(.107).margin(.0005));
  CHECK(printed_loss({0, 1, 50, 75}) == Approx(.031).margin(.0005));
  CHECK(printed_loss({0, 1, 10, 80}) == Approx(.285).margin(.0005));
  CHECK(printed_loss({0, 1, 10, 0}) == 0);
}

TEST_CASE("The density of the printed estimate at height 0 agrees with samples of the lobe") {
  const Case one{0, 1, 10, 80};
  const double angle = one.degrees * std::numbers::pi / 180, low = 0.01;
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr int count = 1'000'000;
  int inside = 0;
  for (int i = 0; i < count; ++i) {
    const double z = std::pow(uniform(generator), 1 / (one.exponent + 1));
    const double x = std::sqrt(1 - z * z) * std::cos(2 * std::numbers::pi * uniform(generator));
    const double height = z * std::cos(angle) - x * std::sin(angle);
    inside += std::abs(height) < low ? 1 : 0; // on both sides of 0, so that the slope cancels
  }
  const double expected = 2 * low * count * printed_density_at_horizon(one);
  CHECK(std::abs(inside - expected) < 4 * std::sqrt(expected) + 1e-3 * expected);
}

TEST_CASE("A biased strategy and a divergent variance are marked, and a divergent variance is nan") {
  const TemporaryFolder folder;
  SamplingOptions options = options_for(folder);
  options.samples = 1 << 18;
  options.cases = {{.4, .4, 10, 80}};
  options.strategies = {"lobe-estimate-printed", "lobe-estimate", "lobe-ks"};
  REQUIRE(write_sampling_tables(options));
  for (const char* table : {"sampling.csv", "sampling-no-roulette.csv"}) {
    const auto rows = rows_of(folder, table);
    REQUIRE(rows.size() == 9);
    for (const std::string& light : light_names()) {
      CsvRow printed = row_of(rows, "lobe-estimate-printed", light);
      CHECK_THAT(printed["marks"], Catch::StartsWith("biased infinite-variance-suspected"));
      for (const char* column :
           {"variance", "variance_standard_error", "variance_times_cost", "variance_times_rays"})
        CHECK(std::isnan(number(printed, column)));
      CHECK(number(printed, "sample_variance") > 0);
      for (const char* sound : {"lobe-estimate", "lobe-ks"}) {
        CsvRow row = row_of(rows, sound, light);
        CAPTURE(sound, light);
        CHECK(row["marks"].empty());
        CHECK(row["variance"] == row["sample_variance"]);
        CHECK(number(row, "variance_times_cost") ==
              Approx(number(row, "variance") * number(row, "ns_per_sample")).epsilon(1e-4));
      }
    }
  }
  CHECK(number(row_of(rows_of(folder, "sampling.csv"), "lobe-estimate-printed", "constant"), "bias_sigma") <
        -10);
}

TEST_CASE("Too few samples are marked as unresolved") {
  const TemporaryFolder folder;
  SamplingOptions options = options_for(folder);
  options.cases = {{0, .9, 1e6, 30}};
  options.strategies = {"cosine", "exact"};
  options.lights = {Light::constant};
  REQUIRE(write_sampling_tables(options));
  const auto rows = rows_of(folder, "sampling.csv");
  CHECK_THAT(row_of(rows, "cosine", "constant")["marks"], Catch::Contains("unresolved"));
  CHECK(row_of(rows, "exact", "constant")["marks"].empty());
}

TEST_CASE("A less efficient strategy has more variance and more variance x cost") {
  const TemporaryFolder folder;
  SamplingOptions options = options_for(folder);
  options.samples = 1 << 18;
  options.cases = {{.1, .8, 90, 30}};
  options.strategies = {"uniform", "cosine", "lobe-rho", "exact"};
  REQUIRE(write_sampling_tables(options));
  const auto rows = rows_of(folder, "sampling.csv"), bare = rows_of(folder, "sampling-no-roulette.csv");
  for (const std::string& light : light_names())
    for (const char* column : {"variance", "variance_times_rays"}) {
      CAPTURE(light, column);
      const double uniform = number(row_of(rows, "uniform", light), column),
                   cosine = number(row_of(rows, "cosine", light), column),
                   exact = number(row_of(rows, "exact", light), column);
      CHECK(uniform > 1.2 * cosine);
      CHECK(cosine > 30 * exact);
      CHECK(exact > number(row_of(bare, "exact", light), column)); // roulette costs variance
    }
  // With roulette, which renders use with every strategy, those that ignore the lobe have more variance too.
  const auto plain = rows_of(folder, "sampling-plain-roulette.csv");
  CHECK(plain.size() == 2 * light_names().size());
  for (const std::string& light : light_names())
    for (const char* strategy : {"uniform", "cosine"}) {
      const CsvRow row = row_of(plain, strategy, light);
      CHECK(row.at("roulette") == "1");
      CHECK(number(row, "rays_per_sample") == Approx(0.79).margin(0.02)); // the reflectivity
      CHECK(number(row, "variance") > number(row_of(rows, strategy, light), "variance"));
      CHECK(std::abs(number(row, "bias_sigma")) < 4.5); // of 6, one is further off in 1 of 25,000 runs
    }
  // A sample of `exact` takes about twice as long; other load on the machine changes that by a factor
  // below 15.
  for (const std::string& light : light_names())
    CHECK(number(row_of(rows, "cosine", light), "variance_times_cost") >
          number(row_of(rows, "exact", light), "variance_times_cost"));
  // Without roulette `exact` has no variance under constant light; `lobe-rho` has.
  CHECK(number(row_of(bare, "exact", "constant"), "variance") < 1e-10);
  CHECK(number(row_of(bare, "lobe-rho", "constant"), "variance") > 1e-4);
}

TEST_CASE("An interrupted run resumes and ends with the same rows as a whole run") {
  const TemporaryFolder whole, stopped;
  SamplingOptions options = options_for(whole);
  options.cases = {{.4, .4, 10, 60}, {.1, .8, 90, 30}};
  options.strategies = {"cosine", "lobe-rho"};
  REQUIRE(write_sampling_tables(options));

  options.folder = stopped.path();
  int asked = 0;
  options.interrupted = [&asked] { return ++asked > 3; };
  CHECK_FALSE(write_sampling_tables(options));
  const std::string kept = TemporaryFolder::read(stopped / "sampling.csv");
  CHECK(rows_of(stopped, "sampling.csv").size() == 6);
  CHECK(rows_of(stopped, "sampling-no-roulette.csv").size() == 3);
  stopped.write("sampling.csv", kept + "cosine,0.1,0.8,90,30,81"); // killed while writing a row

  options.interrupted = {};
  REQUIRE(write_sampling_tables(options));
  CHECK_THAT(TemporaryFolder::read(stopped / "sampling.csv"), Catch::StartsWith(kept));
  for (const char* table : {"sampling.csv", "sampling-no-roulette.csv", "sampling-plain-roulette.csv"}) {
    const auto expected = rows_of(whole, table), found = rows_of(stopped, table);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      for (const char* column : {"strategy", "kd", "ks", "n", "theta_deg", "samples", "mean", "variance",
                                 "rays_per_sample", "integrand"})
        CHECK(found[i].at(column) == expected[i].at(column));
  }

  // A complete table is not measured again, unless the settings differ or `fresh` is set.
  const std::string complete = TemporaryFolder::read(stopped / "sampling.csv");
  REQUIRE(write_sampling_tables(options));
  CHECK(TemporaryFolder::read(stopped / "sampling.csv") == complete);
  options.fresh = true;
  REQUIRE(write_sampling_tables(options));
  CHECK(TemporaryFolder::read(stopped / "sampling.csv") != complete); // at least the times differ
  CHECK(rows_of(stopped, "sampling.csv").front().at("mean") ==
        rows_of(whole, "sampling.csv").front().at("mean"));
  options.fresh = false;
  options.seed = 2;
  REQUIRE(write_sampling_tables(options));
  CHECK(rows_of(stopped, "sampling.csv").front().at("mean") !=
        rows_of(whole, "sampling.csv").front().at("mean"));
}
