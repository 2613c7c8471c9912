#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "kernel_copy.h"

TEST_CASE("phlux verify: a table, and every figure as JSON") {
  const TemporaryFolder folder;
  const Outcome outcome = run({{"verify", "--quick", "--strategy", "exact", "--strategy",
                                "lobe-estimate-printed", "--json", "v.json"},
                               folder.path(),
                               {},
                               {}});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out.find("WIDTH") != std::string::npos);
  CHECK(outcome.out.find("lobe-estimate-printed: loss as derived: biased, as printed in CW 197") !=
        std::string::npos);
  CHECK(outcome.out.find("  directions  ") != std::string::npos);
  CHECK(outcome.out.find("sampled directions against the density, over cells of the sphere (chi-square)") !=
        std::string::npos);
  CHECK(outcome.out.find("passed: ") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"v.json"});
  const auto json = nlohmann::json::parse(TemporaryFolder::read(folder / "v.json"));
  for (const char* key : {"device", "platform", "driver"}) CHECK(json.at(key).is_string());
  CHECK(json.at("width").get<int>() >= 1);
  CHECK(json.at("passed") == true);
  CHECK(json.at("p_values").get<int>() > 100);
  CHECK(json.at("results").size() > 20);
  CHECK(json.at("conclusions").empty());
  for (const auto& result : json.at("results")) {
    for (const char* key : {"strategy", "check", "figure", "where", "meaning", "look_at", "note"})
      CHECK(result.at(key).is_string());
    for (const char* key : {"worst", "limit", "figures"}) CHECK(result.at(key).is_number());
    CHECK(result.at("passed") == true);
    CHECK(result.at("files").empty());
  }
}

TEST_CASE("phlux verify: a wrong kernel is named, with histograms as files") {
  const TemporaryFolder folder;
  const KernelCopy wrong("phong/strategies/exact.cl", "Vec3 v = cosine_power_direction(m.exponent + 1.0f,",
                         "Vec3 v = cosine_power_direction(m.exponent,");
  const Outcome outcome =
      run({{"verify", "--quick", "--strategy", "exact", "--kernel-dir", wrong.folder().string()},
           folder.path(),
           {},
           {}});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("FAILED exact directions") != std::string::npos);
  CHECK(outcome.out.find("look at phong_sample (kernels/phong/strategies/exact.cl)") != std::string::npos);
  CHECK(outcome.out.find("written: verify-exact-directions.csv") != std::string::npos);
  CHECK(folder.names().contains("verify-exact-directions.csv"));
  CHECK(folder.names().contains("verify-exact-partial.png"));
}

TEST_CASE("phlux verify: an integrator that must not be used is named") {
  const TemporaryFolder folder;
  const KernelCopy wrong("transport/contributions.cl", "pack_lanes(m, c.value.x)",
                         "pack_lanes(m, 0.99f * c.value.x)");
  const Outcome outcome = run({{"verify", "--quick", "--integrator", "light", "--json", "v.json",
                                "--kernel-dir", wrong.folder().string()},
                               folder.path(),
                               {},
                               {}});
  CHECK(outcome.exit_code == 1);
  const std::string line = "do not use --integrator light on this device: the furnace is ";
  CHECK(outcome.out.find("\n" + line) != std::string::npos);
  const auto json = nlohmann::json::parse(TemporaryFolder::read(folder / "v.json"));
  CHECK(json.at("conclusions").at(0).get<std::string>().starts_with(line));
  CHECK(json.at("results").size() == 3);
  for (const auto& result : json.at("results")) CHECK(result.at("integrator") == "light");
  CHECK(json.at("results").at(1).at("check") == "furnace");
  CHECK(json.at("results").at(1).at("passed") == false);
}

TEST_CASE("phlux verify: wrong usage") {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"verify", "--strategy", "exakt"},
                                                    {"verify", "--kernel-dir", "nowhere"},
                                                    {"verify", "--width", "3"},
                                                    {"verify", "--integrator", "paths"},
                                                    {"verify", "--integrator", "path", "--model", "phong"},
                                                    {"verify", "--samples", "0"}}) {
    const Outcome outcome = run({arguments, folder.path(), {}, {}});
    CAPTURE(arguments.back());
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.is_one_line_error());
  }
}
