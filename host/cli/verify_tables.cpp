#include "cli/verify_tables.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/spelling.h"
#include "cli/table.h"
#include "terminal.h"
#include "verify/integrators/methods.h"
#include "verify/meanings.h"

namespace phlux::cli {
namespace {

using verify::Kind;
using verify::Report;
using verify::Result;
using verify::Sense;
using Rows = std::vector<std::vector<std::string>>;
using Filter = std::function<bool(const Result&)>;

std::string figure(const Result& result) {
  if (!result.passed) return fmt::format("FAIL {:.1e}", result.worst);
  return fmt::format("{}{:.2g}", result.sense == Sense::probability ? "p " : "", result.worst);
}

std::string limit_text(const Result& result) {
  return fmt::format("{} {:.3g}", result.sense == Sense::probability ? "p >" : "<=", result.limit);
}

Filter of_kind(Kind kind) {
  return [kind](const Result& result) { return verify::kind_of(result) == kind; };
}

// Techniques have a table of their own.
bool is_technique(const Result& result) {
  const verify::Method* method = verify::find_method(result.strategy);
  return method && method->settings.techniques;
}

// In the order of their first appearance.
std::vector<std::string> distinct(const Report& report, const Filter& filter, std::string Result::*member) {
  std::vector<std::string> names;
  for (const Result& result : report.results())
    if (filter(result) && std::ranges::find(names, result.*member) == names.end())
      names.push_back(result.*member);
  return names;
}

const Result* find(const Report& report, const std::string& strategy, const std::string& check) {
  const auto found = std::ranges::find_if(
      report.results(), [&](const Result& r) { return r.strategy == strategy && r.check == check; });
  return found == report.results().end() ? nullptr : &*found;
}

// One column per check, the strategies below each other; what is not checked for a strategy is "-".
std::vector<std::string> column_of(const Report& report, const std::string& check,
                                   const std::vector<std::string>& strategies) {
  std::vector<std::string> column{check, ""};
  for (const std::string& strategy : strategies) {
    const Result* result = find(report, strategy, check);
    column.push_back(result ? figure(*result) : "-");
    if (result) column[1] = limit_text(*result);
  }
  return column;
}

// In blocks of columns as wide as a terminal.
void print_columns(const Report& report, const std::string& title, const Filter& filter) {
  constexpr std::size_t columns_per_block = 7;
  const auto names = distinct(report, filter, &Result::strategy),
             checks = distinct(report, filter, &Result::check);
  for (std::size_t first = 0; first < checks.size(); first += columns_per_block) {
    Rows rows{{title}, {"  limit"}};
    for (const std::string& name : names) rows.push_back({name});
    for (std::size_t i = first; i < std::min(checks.size(), first + columns_per_block); ++i) {
      const auto column = column_of(report, checks[i], names);
      for (std::size_t row = 0; row < rows.size(); ++row) rows[row].push_back(column[row]);
    }
    print_table(rows);
    say("\n");
  }
}

// One row per check of the strategy or model of this name; empty: of the Phong model.
void print_rows(const Report& report, const std::string& name) {
  Rows rows{{name.empty() ? "MODEL" : name, "worst", "limit", "where"}};
  for (const Result& result : report.results())
    if (result.strategy == name)
      rows.push_back({result.check, figure(result), limit_text(result), result.where});
  print_table(rows);
  say("\n");
}

// One row per number of edges, one column per number of light vertices.
void print_techniques(const Report& report) {
  const auto first = std::ranges::find_if(report.results(), is_technique);
  if (first == report.results().end()) return;
  Rows rows{{"EDGES"}};
  for (int s = 0; s <= verify::technique_edges; ++s) rows[0].push_back(fmt::format("s = {}", s));
  rows[0].emplace_back("weighted");
  std::string limit;
  const auto cell = [&](const std::string& check) {
    const Result* result = find(report, first->strategy, check);
    if (result) limit = limit_text(*result);
    return result ? figure(*result) : "-";
  };
  for (int edges = 1; edges <= verify::technique_edges; ++edges) {
    std::vector<std::string>& row = rows.emplace_back();
    row.push_back(std::to_string(edges));
    for (const film::Technique& technique : verify::techniques_of(edges))
      row.push_back(cell(verify::check_of(technique)));
    row.resize(rows[0].size() - 1);
    row.push_back(cell(verify::check_of_length(edges)));
  }
  say("TECHNIQUES of bidir with s light vertices, limit {}\n", limit);
  print_table(rows);
  say("\n");
}

bool of_integrator(const Result& result) {
  return verify::kind_of(result) == Kind::integrator && !is_technique(result);
}

std::string name_of(const Result& result) {
  return (result.strategy.empty() ? "model" : result.strategy) + " " + result.check;
}

} // namespace

void print_results(const Report& report) {
  print_columns(report, "STRATEGY", of_kind(Kind::strategy));
  for (const Kind kind : {Kind::model, Kind::lobe})
    for (const std::string& name : distinct(report, of_kind(kind), &Result::strategy))
      print_rows(report, name);
  print_columns(report, "INTEGRATOR", of_integrator);
  print_techniques(report);
}

void print_meanings(const Report& report) {
  say("Each figure is the worst over materials, angles and channels; p is a p-value.\n");
  Rows rows;
  for (const auto& [title, filter] : {std::pair<const char*, Filter>{"STRATEGY", of_kind(Kind::strategy)},
                                      {"MODEL", of_kind(Kind::model)},
                                      {"MODEL", of_kind(Kind::lobe)},
                                      {"INTEGRATOR", of_integrator}}) {
    std::vector<std::string> checks = distinct(report, filter, &Result::check);
    if (!checks.empty()) rows.push_back({title});
    for (const Result& result : report.results()) {
      const auto found = filter(result) ? std::ranges::find(checks, result.check) : checks.end();
      if (found == checks.end()) continue;
      checks.erase(found);
      rows.push_back({"  " + result.check, verify::meaning_of(result)});
    }
  }
  if (std::ranges::any_of(report.results(), is_technique)) {
    rows.push_back({"TECHNIQUES"});
    rows.push_back(
        {"  s = 0, 1, ...", "mean radiance of paths by one technique alone, without its weight (t-test)"});
    rows.push_back({"  weighted", "the same by all techniques that make such paths, weighted (t-test)"});
  }
  print_table(rows);
  say("\n");
}

void print_failures(const Report& report) {
  for (const Result& result : report.results())
    if (result.passed && !result.note.empty())
      say("{}{}: {}\n", result.strategy.empty() ? "" : result.strategy + ": ", result.check, result.note);
  for (const Result& result : report.results()) {
    if (result.passed) continue;
    say("FAILED {}: {}{:.6g}, must be {}, for {}\n", name_of(result),
        result.note.empty() ? "" : with_options(result.note) + ": ", result.worst, limit_text(result),
        result.where);
    say("  what it is: {}\n", verify::meaning_of(result));
    if (const std::string function = verify::function_to_look_at(result); !function.empty())
      say("  look at {}\n", function);
    for (const std::string& file : result.files) say("  written: {}\n", file);
  }
}

} // namespace phlux::cli
