// The grammar of `phlux bench`.
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "bench/rays.h"
#include "cli/grammar.h"
#include "cli/values.h"
#include "errors.h"

namespace phlux::cli {
namespace {

const char* const default_folder = "bench-results";

// What every measurement has: a folder, a device and a width.
template<class Options>
void add_common(CLI::App& app, Options& options) {
  options.folder = default_folder;
  add_value(
      app, "--out", "DIR",
      fmt::format("the folder that the tables go to, made where it is missing; default: {}", default_folder),
      [&options](const std::string& text) {
        if (text.empty()) throw UsageError("--out '': must be a folder's name");
        options.folder = text;
      });
  add_value(app, "--device", "SPEC", "P:D as `phlux devices` lists them, cpu, gpu, or a part of a name",
            [&options](const std::string& text) { options.devices = {text}; });
  add_value(app, "--width", "N", "lanes of a work item: 1, 4, 8 or 16; default: what suits the device",
            [&options](const std::string& text) {
              const std::vector<std::string> widths = {"1", "4", "8", "16"};
              options.lanes = std::stoi(widths[choice("--width", text, widths)]);
            });
  add_value(app, "--kernel-dir", "FOLDER",
            "kernel sources to use instead of the built-in ones, while developing",
            [&options](const std::string& text) {
              if (!std::filesystem::is_directory(text))
                throw UsageError(fmt::format("--kernel-dir {}: must be a folder of kernel files", text));
              options.kernel_dir = text;
            });
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  if (text.empty() || text.ends_with(',')) parts.emplace_back();
  return parts;
}

void add_rays(CLI::App& bench, std::optional<Command>& command) {
  CLI::App& app = *bench.add_subcommand("rays", "Traversal against Embree's on the same rays: rays.csv");
  const auto options = std::make_shared<bench::RaysOptions>();
  add_common(app, *options);
  add_value(app, "--triangles", "N,N,...", "sizes of the mesh; default: 36,20000,500000",
            [options](const std::string& text) {
              constexpr std::uint64_t least = 36, most = 50'000'000;
              options->triangles.clear();
              for (const std::string& part : split(text))
                options->triangles.push_back(whole_number("--triangles", part, least, most));
            });
  add_value(app, "--traversal", "NAME", "brute (every shape), bvh or auto; default: auto",
            [options](const std::string& text) {
              options->traversal =
                  static_cast<render::Traversal>(choice("--traversal", text, {"auto", "brute", "bvh"}));
            });
  app.final_callback([&command, options] {
    command = [options] {
      bench::measure_rays(*options);
      return 0;
    };
  });
}

} // namespace

void add_bench(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("bench", "Measures this device: tables (CSV) and figures");
  app.require_subcommand(1);
  app.footer("phlux bench COMMAND --help lists the options of one.");
  add_rays(app, command);
}

} // namespace phlux::cli
