// How the command line's options are declared, whichever the command.
#pragma once

#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/command_line.h"

namespace phlux::cli {

// The help's second column starts at first_column and ends at last_column.
inline constexpr std::size_t first_column = 30, last_column = 100;

inline std::string wrapped(const std::string& text) {
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

// An option with one value, which `set` is given as text; when repeated, the last one counts, as scripts
// expect.
template<class Set>
CLI::Option* add_value(CLI::App& app, const std::string& names, const std::string& value,
                       const std::string& help, Set set) {
  return app
      .add_option_function<std::string>(
          names, [set](const std::string& text) { set(text); }, wrapped(help))
      ->type_name(value)
      ->take_last();
}

// An option that may be repeated, one value each time.
template<class Add>
CLI::Option* add_values(CLI::App& app, const std::string& names, const std::string& value,
                        const std::string& help, Add add) {
  return app
      .add_option_function<std::vector<std::string>>(
          names,
          [add](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) add(text);
          },
          wrapped(help))
      ->type_name(value)
      ->allow_extra_args(false);
}

/// `phlux bench`, with all that it measures. @throws UsageError while parsing
void add_bench(CLI::App& program, std::optional<Command>& command);

/// `phlux verify`. @throws UsageError while parsing
void add_verify(CLI::App& program, std::optional<Command>& command);

} // namespace phlux::cli
