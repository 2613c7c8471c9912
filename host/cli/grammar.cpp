#include "cli/grammar.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "cli/spelling.h"
#include "cli/work.h"
#include "errors.h"

namespace phlux::cli {
namespace {

constexpr std::pair<const char*, char> letters[] = {{"integrator", 'i'}, {"spp", 'n'}};

} // namespace

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

std::string only_value(const std::string& names, const std::string& joined) {
  const std::string option = names.substr(names.rfind(',') + 1);
  std::string first;
  std::size_t begin = 0;
  for (bool is_first = true; begin <= joined.size(); is_first = false) {
    const std::size_t end = std::min(joined.find(between_values, begin), joined.size());
    const std::string value = joined.substr(begin, end - begin);
    if (!is_first && value != first)
      throw UsageError(
          fmt::format("{} {}: and {} {} is given too: give one of the two", option, value, option, first));
    first = value;
    begin = end + 1;
  }
  return first;
}

void add_file(CLI::App& app, const std::string& names, const std::string& value, const std::string& help,
              std::filesystem::path& file) {
  add_value(app, names, value, help, [&file, names](const std::string& text) {
    if (text.empty()) throw UsageError(fmt::format("{} '': must be a file name", names));
    file = text;
  });
}

void add_exposure(CLI::App& app, std::optional<double>& stops) {
  add_value(app, "--exposure", "EV",
            "of the picture: radiance is multiplied by 2^EV; default: such that the image's log-average is "
            "middle grey",
            [&stops](const std::string& text) {
              constexpr double most = 100.0;
              stops = settings::number_within("--exposure", text, -most, most);
            });
}

void add_setting(CLI::App& app, const settings::Setting& setting, settings::Choices& choices) {
  std::string names = "--" + setting.name, help = with_options(setting.help);
  for (const auto& [name, letter] : letters)
    if (setting.name == name) names.insert(0, fmt::format("-{},", letter));
  const std::string usual = setting.from_scene ? "the scene's" : setting.text({});
  if (!usual.empty()) help += "; default: " + usual;
  add_value(app, names, setting.placeholder, help,
            [&](const std::string& text) { choices.choose(setting, text); });
}

void add_width(CLI::App& app, const std::string& what, int& lanes) {
  add_value(app, "--width", "N", what + ": 1, 4, 8 or 16; default: what suits the device",
            [&lanes](const std::string& text) {
              settings::Settings read;
              settings::named("width").read(text, read);
              lanes = read.lanes;
            });
}

void add_traversal(CLI::App& app, render::Traversal& traversal) {
  const settings::Setting& setting = settings::named("traversal");
  add_value(app, "--traversal", setting.placeholder, setting.help + "; default: auto",
            [&](const std::string& text) {
              settings::Settings read;
              setting.read(text, read);
              traversal = read.traversal;
            });
}

void add_kernel_dir(CLI::App& app, std::filesystem::path& folder) {
  add_value(app, "--kernel-dir", "FOLDER",
            "folder of kernel sources to use instead of the built-in ones; for development",
            [&folder](const std::string& text) {
              if (!std::filesystem::is_directory(text) && !is_worker())
                throw UsageError(fmt::format("--kernel-dir {}: must be a folder of kernel files", text));
              folder = text;
            });
}

void add_lobes(CLI::App& app, const std::string& help, std::vector<std::filesystem::path>& lobes) {
  add_values(app, "--lobe", "NAME.cl", help, [&lobes](const std::string& text) { lobes.emplace_back(text); });
}

void add_one_device(CLI::App& app, std::vector<std::string>& devices, int& lanes,
                    std::filesystem::path& kernel_dir) {
  add_value(app, "--device", "SPEC",
            "indices P:D (platform:device) as listed by phlux devices, cpu, gpu, or a part of the name of a "
            "platform or device",
            [&devices](const std::string& text) { devices = {text}; });
  add_width(app, "number of paths that a work-item traces together", lanes);
  add_kernel_dir(app, kernel_dir);
}

} // namespace phlux::cli
