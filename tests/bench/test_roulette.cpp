#include "bench/roulette/roulette.h"

#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

using namespace phlux;
using namespace phlux::bench;
using Catch::Contains;

TEST_CASE(
    "The variants of roulette: the defaults first, every roulette from edges 1 and 5, and none, once each") {
  RouletteOptions options;
  options.strategies = {"exact", "lobe-ks"};
  const std::vector<RouletteVariant> variants = roulette_variants(options);
  CHECK(variants.front() == RouletteVariant());
  for (std::size_t i = 0; i < variants.size(); ++i) CHECK(std::ranges::count(variants, variants[i]) == 1);
  for (const std::string& strategy : options.strategies) {
    std::set<std::string> met;
    for (const RouletteVariant& variant : variants)
      if (variant.strategy == strategy) met.insert(variant.options());
    const std::string prefix = strategy == "exact" ? "" : "--strategy lobe-ks ";
    for (const std::string& roulette : options.roulettes)
      for (const char* depth : {"1", "5"})
        CHECK(met.count(prefix + "--roulette " + roulette + " --rr-depth " + depth) == 1);
    CHECK(met.count(prefix + "--rr-depth -1") == 1);
  }
}

TEST_CASE("The answer on roulette is the least geometric mean, with what is not significantly worse") {
  const RouletteVariant defaults, good{"exact", render::Roulette::kd_ks, 5},
      close{"exact", render::Roulette::throughput, 5}, bad{"exact", render::Roulette::kd_ks, 1};
  std::vector<RouletteCost> costs;
  const auto add = [&](const std::string& scene, const RouletteVariant& variant, double ratio, double error) {
    costs.push_back({scene, "bidir", variant, {}, {}, {ratio, error, 9}, 1});
  };
  for (const std::string scene : {"a", "b"}) {
    add(scene, defaults, 1, 0);
    add(scene, good, scene == "a" ? 0.5 : 0.98, 0.01);
    add(scene, close, 0.71, 0.02);
    add(scene, bad, 1.5, 0.1);
  }
  add("a", {"rejection", render::Roulette::kd_ks, 5}, 0.1, 0.01); // b's lobe is too narrow for it
  const std::vector<std::string> answers = roulette_answers(costs);
  REQUIRE(answers.size() == 1);
  CHECK_THAT(answers[0], Contains("bidir: --roulette kd-ks --rr-depth 5 needs 0.700 (95%: 0."));
  CHECK_THAT(answers[0], Contains("times the rays of " + defaults.options() + " for the same error"));
  CHECK(answers[0].ends_with("; tied with --roulette throughput --rr-depth 5 (0.710)"));
}
