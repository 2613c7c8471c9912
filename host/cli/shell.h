// Texts that are made from the grammar of the command line: shell completion and the manual page.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace phlux::cli {

/// An option as the texts show it.
struct OptionText {
  std::vector<std::string> names; ///< "-o", "--output"
  std::string value;              ///< placeholder; empty for a flag
  std::string help;               ///< one line
  std::string group;
  std::vector<std::string> choices; ///< names that are values; empty: others
  [[nodiscard]] bool takes_file() const;
};

/// A command: "" for the program, "render", "bench scenes".
struct CommandText {
  std::string name, help, footer;
  std::vector<OptionText> options, positionals;
  std::vector<std::string> commands; ///< names of its own commands
};

/// The program and all of its commands, each before its own.
[[nodiscard]] std::vector<CommandText> commands_of(const CLI::App& program);

/// Scripts for the shell: bash's for `source` or bash-completion's folder, zsh's for a folder of its fpath.
[[nodiscard]] std::string bash_completion(const std::vector<CommandText>& commands);
[[nodiscard]] std::string zsh_completion(const std::vector<CommandText>& commands);

/// The manual page phlux(1), in troff's man macros.
[[nodiscard]] std::string manual_page(const std::vector<CommandText>& commands);

} // namespace phlux::cli
