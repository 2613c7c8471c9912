#include "bench/common/report/draw.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "bench/common/report/python.h"
#include "errors.h"
#include "files/output.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

// Runs main() of the module, then of report.py. `import NAME` finds the embedded NAME.py first. JSON strings
// are valid Python strings.
std::string python_program(const std::string& module) {
  nlohmann::json sources;
  for (const sources::EmbeddedFile& file : embedded_scripts())
    sources[std::filesystem::path(file.name).stem().string()] = file.text;
  return fmt::format(R"(import importlib, importlib.abc, importlib.util, sys
sources = {}
class Embedded(importlib.abc.MetaPathFinder, importlib.abc.InspectLoader):
    def find_spec(self, name, path, target=None):
        return importlib.util.spec_from_loader(name, self) if name in sources else None
    def get_source(self, name):
        return sources[name]
sys.meta_path.insert(0, Embedded())
for name in ('{}', 'report'):
    importlib.import_module(name).main()
)",
                     sources.dump(-1, ' ', true), module);
}

} // namespace

void draw_charts(const std::filesystem::path& folder, const std::string& module) {
  const auto python = find_python("matplotlib");
  if (!python)
    throw WriteError("the charts cannot be drawn without matplotlib: install the package python3-matplotlib; "
                     "the tables are written");
  const PythonOutcome outcome = run_python(*python, {folder.string()}, python_program(module));
  if (outcome.exit_code != 0)
    throw WriteError(fmt::format("the charts cannot be drawn: {}: {}", *python,
                                 outcome.errors.empty() ? fmt::format("exit code {}", outcome.exit_code)
                                                        : last_line(outcome.errors)));
  if (!outcome.errors.empty()) spdlog::info("{}", outcome.errors);
}

void report_answers(const std::filesystem::path& folder, const std::string& module,
                    const std::vector<std::string>& answers) {
  const std::string text = fmt::format("{}\n", fmt::join(answers, "\n"));
  files::write_file(folder / (module + ".verdict.txt"), text);
  say("{}\n{}", (folder / (module + ".csv")).string(), text);
  draw_charts(folder, module);
}

} // namespace phlux::bench
