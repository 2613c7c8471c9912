#include "bench/common/report/draw.h"

#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "bench/common/report/python.h"
#include "bench/common/report/scripts.h"
#include "errors.h"

namespace phlux::bench {
namespace {

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

std::string python_with(const char* module, const char* package, const char* what) {
  if (const auto python = find_python(module)) return *python;
  throw WriteError(
      fmt::format("{} without {}: install the package {}; the tables are written", what, module, package));
}

void run(const std::string& python, const std::filesystem::path& folder, const std::string& program,
         const char* what) {
  const PythonOutcome outcome = run_python(python, {folder.string()}, program);
  if (outcome.exit_code != 0)
    throw WriteError(fmt::format("{}: {}: {}", what, python,
                                 outcome.errors.empty() ? fmt::format("exit code {}", outcome.exit_code)
                                                        : last_line(outcome.errors)));
  if (!outcome.errors.empty()) spdlog::info("{}", outcome.errors);
}

// A program whose `import chart_style` finds the text in this binary. JSON's strings are Python's too.
std::string with_chart_style(std::string_view script) {
  return fmt::format("import sys, types\n"
                     "chart_style = sys.modules['chart_style'] = types.ModuleType('chart_style')\n"
                     "exec(compile({}, 'chart_style.py', 'exec'), chart_style.__dict__)\n{}",
                     nlohmann::json(chart_style_script()).dump(-1, ' ', true), script);
}

constexpr const char* no_charts = "the charts cannot be drawn";
constexpr const char* no_report = "the report cannot be written";

} // namespace

void write_report(const std::filesystem::path& folder) {
  run(python_with("json", "python3", no_report), folder, std::string(report_script()), no_report);
}

void draw_charts(const std::filesystem::path& folder, std::string_view script) {
  const std::string python = python_with("matplotlib", "python3-matplotlib", no_charts);
  run(python, folder, with_chart_style(script), no_charts);
  write_report(folder);
}

} // namespace phlux::bench
