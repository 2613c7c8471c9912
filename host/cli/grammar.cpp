#include "cli/grammar.h"

#include <sstream>

#include <fmt/format.h>

#include "cli/values.h"
#include "errors.h"

namespace phlux::cli {

std::string wrapped(const std::string& text) {
  std::string lines;
  std::size_t column = first_column;
  std::istringstream words(text);
  for (std::string word; words >> word; column += word.size() + 1) {
    if (!lines.empty()) lines += column + word.size() > last_column ? '\n' : ' ';
    if (lines.ends_with('\n')) column = first_column;
    lines += word;
  }
  return lines;
}

void add_width(CLI::App& app, const std::string& what, int& lanes) {
  add_value(app, "--width", "N", what + ": 1, 4, 8 or 16; default: what suits the device",
            [&lanes](const std::string& text) {
              const std::vector<std::string> widths = {"1", "4", "8", "16"};
              lanes = std::stoi(widths[choice("--width", text, widths)]);
            });
}

void add_traversal(CLI::App& app, render::Traversal& traversal) {
  add_value(app, "--traversal", "NAME", "brute (every shape), bvh or auto; default: auto",
            [&traversal](const std::string& text) {
              traversal =
                  static_cast<render::Traversal>(choice("--traversal", text, render::traversal_names()));
            });
}

void add_kernel_dir(CLI::App& app, std::filesystem::path& folder) {
  add_value(app, "--kernel-dir", "FOLDER",
            "kernel sources to use instead of the built-in ones, while developing",
            [&folder](const std::string& text) {
              if (!std::filesystem::is_directory(text))
                throw UsageError(fmt::format("--kernel-dir {}: must be a folder of kernel files", text));
              folder = text;
            });
}

void add_one_device(CLI::App& app, std::vector<std::string>& devices, int& lanes,
                    std::filesystem::path& kernel_dir) {
  add_value(app, "--device", "SPEC",
            "P:D as `phlux devices` lists them, cpu, gpu, or a part of a platform's or else a device's name",
            [&devices](const std::string& text) { devices = {text}; });
  add_width(app, "lanes of a work item", lanes);
  add_kernel_dir(app, kernel_dir);
}

} // namespace phlux::cli
