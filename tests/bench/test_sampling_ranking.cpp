// The ranking of strategies and the sentence on it, from constructed tables.
#include <cmath>
#include <map>
#include <random>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "bench/sampling/sampling_table.h"
#include "bench/sampling/sampling_verdict.h"
#include "measure/statistics.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::bench;

namespace {

// A row of a table: the exact value is 2, a sample of every strategy goes on and takes 10 ns.
struct Row {
  std::string strategy;
  double variance, standard_error;
  std::string light = "constant", marks = {}, one = "0.3,0.6,200,70";
  bool roulette = false;
  double nanoseconds = 10, least = 10, most = 10;
};

SavedTable table_of(const TemporaryFolder& folder, const std::vector<Row>& rows) {
  std::string text = fmt::format("{}\n", fmt::join(sampling_columns(), ","));
  for (const Row& r : rows) {
    std::map<std::string, std::string> values = {
        {"strategy", r.strategy},
        {"kd,ks,n,theta_deg", r.one},
        {"samples", "1000"},
        {"exact", "2"},
        {"variance", fmt::format("{}", r.variance)},
        {"variance_standard_error", fmt::format("{}", r.standard_error)},
        {"rays_per_sample", "1"},
        {"ns_per_sample", fmt::format("{}", r.nanoseconds)},
        {"ns_least", fmt::format("{}", r.least)},
        {"ns_most", fmt::format("{}", r.most)},
        {"rounds", "5"},
        {"roulette", r.roulette ? "1" : "0"},
        {"marks", r.marks},
        {"integrand", r.light}};
    text += r.strategy + "," + r.one;
    for (std::size_t i = 5; i < sampling_columns().size(); ++i) text += "," + values[sampling_columns()[i]];
    text += '\n';
  }
  folder.write("table.csv", text);
  return {folder.path(), "table.csv", sampling_columns()};
}

std::vector<Ranking> rankings(const std::vector<Row>& rows) {
  const TemporaryFolder folder;
  return rankings_of({table_of(folder, rows)}, 90);
}

std::string verdict(const std::vector<Row>& rows) {
  const auto sentences = verdicts_on_cases(rankings(rows), {90, "the device, WIDTH 1"});
  REQUIRE(sentences.size() == 1);
  return sentences.front();
}

const std::string without = " without roulette (the default before edge 5): ";
const std::string with = " with roulette at every bounce (--rr-depth 1): ";
const std::string closing =
    " (--case 0.3,0.6,200,70; cost: processor time of the sampler plus 90 ns for each reflected ray; "
    "the device, WIDTH 1)";

} // namespace

TEST_CASE("The number of standard errors of a p-value is the inverse of the p-value") {
  for (const double p : {1.0, 0.3, 0.05, 1e-9})
    CHECK(measure::normal_p(measure::normal_sigmas(p)) == Approx(p).epsilon(1e-9));
  CHECK(measure::normal_sigmas(0.05) == Approx(1.959964));
}

TEST_CASE("The interval of the ratio to the best follows from the standard errors of variance and cost") {
  const auto all = rankings({{"exact", 4, 0.04}, {"fold", 8, 0.16}});
  REQUIRE(all.size() == 1);
  const auto& [best, second] = std::pair(all[0].competitors[0], all[0].competitors[1]);
  CHECK(best.strategy == "exact");
  CHECK(best.variance == 1); // relative to the square of 2
  CHECK(best.cost == 100);
  CHECK(best.cost_standard_error == 0);
  CHECK(second.factor == 2);
  const double sigmas = 1.959964; // one comparison: 95%
  CHECK(std::log(second.most / 2) == Approx(sigmas * std::hypot(0.01, 0.02)));
  CHECK(std::log(2 / second.least) == Approx(sigmas * std::hypot(0.01, 0.02)));
  // The expected least of five times is 1.163 standard deviations below their median. The standard error of
  // the median is 1.2533 / sqrt(5) standard deviations. The largest time is that of a launch that another
  // program interrupted, and has no effect.
  const auto spread =
      rankings({{"exact", 4, 0.04},
                {.strategy = "fold", .variance = 8, .standard_error = 0, .least = 9, .most = 900}});
  CHECK(spread[0].competitors[1].cost_standard_error ==
        Approx(1 / 1.163 * 1.2533 / std::sqrt(5)).epsilon(0.02));
  // With three comparisons each has the level 1 - 0.95^(1/3): 2.388 standard errors.
  const auto four = rankings({{"exact", 4, 0.04}, {"fold", 8, 0}, {"cosine", 9, 0}, {"disk", 9, 0}});
  CHECK(std::log(four[0].competitors[1].most / 2) == Approx(2.388 * 0.01).epsilon(1e-3));
}

TEST_CASE(
    "Of two equal strategies one is called better in 5% of the tables; of eleven all intervals hold in 95%") {
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal(0, 1);
  constexpr double error = 0.01; // relative, of each variance
  const auto measured = [&](double variance) {
    Competitor c;
    c.variance = variance * std::exp(error * normal(generator));
    c.variance_standard_error = error * c.variance;
    c.cost = 1;
    return c;
  };
  constexpr int tables = 10'000; // the standard error of a rate of 5% is 0.22%
  int false_winners = 0, misses = 0;
  for (int i = 0; i < tables; ++i) {
    false_winners += ranked({measured(1), measured(1)})[1].wins() ? 0 : 1;
    std::vector<Competitor> eleven = {measured(1)};
    while (eleven.size() < 11) eleven.push_back(measured(1 + 0.2 * static_cast<double>(eleven.size())));
    eleven = ranked(eleven);
    bool missed = false;
    for (std::size_t k = 1; k < eleven.size(); ++k) {
      const double factor = 1 + 0.2 * static_cast<double>(k);
      missed = missed || eleven[k].least > factor || eleven[k].most < factor;
    }
    misses += missed ? 1 : 0;
  }
  CHECK(false_winners == Approx(0.05 * tables).margin(4 * 0.0022 * tables));
  // All intervals share the error of the best, so Sidak's correction, for independent ones, is
  // conservative: 3.6%.
  CHECK(misses < 0.05 * tables);
  CHECK(misses > 0.025 * tables);
}

TEST_CASE("The sentence names a clear winner, its factor, the roulette, the light and the cost") {
  CHECK(verdict({{"cosine", 8, 0.08},
                 {"exact", 4, 0.04},
                 {"cosine", 4, 0.04, "constant", "", "0.3,0.6,200,70", true},
                 {"exact", 8, 0.04, "constant", "", "0.3,0.6,200,70", true}}) ==
        "--strategy exact" + without +
            "2.00 times (95%: 1.95 to 2.06) as efficient as cosine in constant light;\n" +
            "--strategy cosine" + with +
            "2.00 times (95%: 1.96 to 2.04) as efficient as exact in constant light" + closing);
}

TEST_CASE("The sentence names every tied strategy") {
  CHECK(verdict({{"fold", 4.04, 0.04}, {"exact", 4, 0.04}, {"mixture", 4.02, 0.04}, {"cosine", 8, 0.04}}) ==
        "--strategy exact" + without +
            "tied with mixture and fold, at 1.00 times (95%: 0.97 to 1.04) the efficiency of mixture in "
            "constant "
            "light" +
            closing);
}

TEST_CASE("Biased strategies and those with too few samples never win") {
  CHECK(verdict({{"lobe-estimate-printed", 1, 0.01},
                 {"uniform", 1, 0.01, "constant", "unresolved"},
                 {"cosine", 8, 0.08},
                 {"exact", 4, 0.04}}) == "--strategy exact" + without +
                                             "2.00 times (95%: 1.95 to 2.06) as efficient as "
                                             "cosine in constant light" +
                                             closing);
  CHECK(
      verdict(
          {{"uniform", 1, 0.01, "constant", "unresolved"}, {"cosine", 1, 0.01, "constant", "unresolved"}}) ==
      "no strategy can be compared without roulette (the default before edge 5): more --samples are needed" +
          closing);
}

TEST_CASE("The sentence on several lights names the strategy that wins in all, or else the safest") {
  CHECK(verdict({{"exact", 0, 0},
                 {"cosine", 8, 0.04},
                 {"exact", 4, 0.04, "horizon-sky"},
                 {"cosine", 3.98, 0.04, "horizon-sky"}}) ==
        "--strategy exact" + without +
            "no variance in constant light; tied with cosine, at 1.00 times (95%: 0.97 to 1.02) the "
            "efficiency of "
            "cosine in horizon-sky light" +
            closing);
  CHECK(verdict({{"exact", 4, 0.04},
                 {"cosine", 8, 0.08},
                 {"exact", 12, 0.12, "horizon-sky"},
                 {"cosine", 4, 0.04, "horizon-sky"}}) ==
        "--strategy cosine, the safest choice for these lights," + without +
            "2.00 times (95%: 1.95 to 2.06) the time of exact in constant light; 3.00 times (95%: 2.92 to "
            "3.08) as "
            "efficient as exact in horizon-sky light" +
            closing);
}

TEST_CASE("The sentence on a grid counts the cases in which each strategy is the best or tied") {
  const auto all = rankings({{"exact", 4, 0.04},
                             {"cosine", 8, 0.08},
                             {"exact", 4, 0.04, "horizon-sky"},
                             {"cosine", 3.98, 0.04, "horizon-sky"},
                             {"exact", 8, 0.04, "constant", "", "0.3,0.6,10,70"},
                             {"cosine", 4, 0.04, "constant", "", "0.3,0.6,10,70"},
                             {"exact", 4, 0.04, "constant", "", "0.3,0.6,1,70"},
                             {"cosine", 8, 0.04, "constant", "", "0.3,0.6,1,70"}});
  CHECK_THAT(
      verdict_on_grid(all, {90, "the device, WIDTH 1"}),
      Catch::StartsWith("--strategy exact" + without +
                        "best in 2 and tied in 1 of 4 cases; takes at most 2 times as long as the best; next "
                        "(best, tied): cosine (1, 1) (a case: a material, angle and light; cost: "));
}
