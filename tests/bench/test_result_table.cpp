#include <algorithm>

#include <catch2/catch.hpp>

#include "bench/common/methods/result_table.h"
#include "bench/common/tables/fingerprint.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::bench;

namespace {

const Method none{"path", "exact", "none"}, mis{"path", "exact", "mis"}, light{"light", "exact", "-"};
const ResultTable::Values key_columns = {"exponent", "light_radius"}, key = {"10", "0.1"},
                          other_key = {"10", "0.01"};

ResultTable open(const TemporaryFolder& folder) {
  return {folder.path(), "t.csv", key_columns, result_columns()};
}

ResultTable::Values values(const MethodResult& result) {
  ReferenceImage reference;
  reference.method = "bidir balance";
  scene::Camera camera;
  camera.width = 3, camera.height = 2;
  const RankedCost cost{.cost = 2 * .25, .ratio = 1.5, .low = .9, .high = 2.25, .rank = Rank::tied};
  return result_values(result, cost, reference, camera, {"a CPU, of some kind", 4, 7, CostClock::processor});
}

MethodResult result_with(Verdict verdict) {
  MethodResult result;
  result.verdict = verdict;
  result.variance = {2, .1};
  result.wall.median = .5;
  result.processor.median = .25;
  result.convergence.push_back({});
  return result;
}

const std::string& value_of(const ResultTable::Values& row, const std::string& column) {
  const auto& columns = result_columns();
  const auto found = std::ranges::find(columns, column);
  REQUIRE(found != columns.end());
  return row[static_cast<std::size_t>(found - columns.begin())];
}

} // namespace

TEST_CASE("The table contains only the values that the verdict of a method allows") {
  const auto sound = values(result_with(Verdict::sound));
  CHECK(sound.size() == result_columns().size());
  CHECK(value_of(sound, "variance_per_sample") == "2");
  CHECK(value_of(sound, "variance_times_seconds") == "1"); // wall-clock time, as seconds_per_sample
  CHECK(value_of(sound, "cost") == "0.5");
  CHECK(value_of(sound, "clock") == "processor");
  CHECK(value_of(sound, "cost_ratio_low") == "0.9");
  CHECK(value_of(sound, "rank") == "tied");
  CHECK(value_of(sound, "device") == "a CPU  of some kind");
  CHECK(value_of(sound, "image") == "3x2");
  const auto suspect = values(result_with(Verdict::suspect_variance));
  CHECK(value_of(suspect, "variance_per_sample").empty());
  CHECK(value_of(suspect, "variance_measured") == "2");
  CHECK(value_of(suspect, "variance_times_seconds").empty());
  const auto biased = values(result_with(Verdict::biased));
  CHECK(value_of(biased, "variance_per_sample") == "2");
  CHECK(value_of(biased, "variance_times_seconds").empty());
  const auto refused = values(result_with(Verdict::refused));
  CHECK(value_of(refused, "verdict") == "refused");
  CHECK(value_of(refused, "seconds_per_sample").empty());
}

TEST_CASE("A measurement is complete if every method has a row of the same settings") {
  const TemporaryFolder folder;
  {
    ResultTable table = open(folder);
    CHECK(table.empty());
    table.add(key, none, values(result_with(Verdict::refused)), "s");
    table.add(key, mis, values(result_with(Verdict::sound)), "s");
    table.write();
  }
  ResultTable table = open(folder);
  CHECK_FALSE(table.empty());
  CHECK(table.has(key, {none, mis}, "s"));
  CHECK_FALSE(table.has(key, {none, mis, light}, "s"));
  CHECK_FALSE(table.has(key, {mis}, "other settings"));
  CHECK_FALSE(table.has(other_key, {mis}, "s"));
  CHECK(table.with_earlier(key, {light, mis}, "s") == std::vector<Method>{light, mis, none});
  CHECK(table.with_earlier(key, {light}, "other settings") == std::vector<Method>{light});
  table.remove(other_key);
  CHECK(table.has(key, {mis}, "s"));
  table.remove(key);
  CHECK(table.empty());
}

TEST_CASE("Fingerprints of \"ab\", \"c\" and \"a\", \"bc\" differ") {
  Fingerprint a, b;
  a.add("ab"), a.add("c");
  b.add("a"), b.add("bc");
  CHECK(a.text() != b.text());
  CHECK(Fingerprint{}.text() == "cbf29ce484222325"); // FNV's offset basis
}
