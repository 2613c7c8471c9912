#include "cli/shell.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "settings/settings.h"

namespace phlux::cli {
namespace {

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
  return text;
}

OptionText text_of(const CLI::Option& option) {
  OptionText text;
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  text.value = option.get_items_expected_max() == 0 ? "" : option.get_type_name();
  if (option.get_positional()) text.names = {option.get_name()};
  text.help = replaced(option.get_description(), "\n", " ");
  text.group = option.get_group();
  for (const settings::Setting& setting : settings::all())
    if (text.names.back() == "--" + setting.name) text.choices = setting.choices;
  return text;
}

void add(const CLI::App& app, const std::string& name, std::vector<CommandText>& commands) {
  CommandText command{.name = name,
                      .help = app.get_description(),
                      .footer = app.get_footer(),
                      .options = {},
                      .positionals = {},
                      .commands = {}};
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? command.positionals : command.options).push_back(text_of(*option));
  const auto own = app.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* each : own) command.commands.push_back(each->get_name());
  commands.push_back(command);
  for (const CLI::App* each : own)
    add(*each, name.empty() ? each->get_name() : name + " " + each->get_name(), commands);
}

// ---- bash

std::string bash_words(const CommandText& command) {
  std::vector<std::string> words = command.commands;
  for (const OptionText& option : command.options)
    words.insert(words.end(), option.names.begin(), option.names.end());
  return fmt::format("{}", fmt::join(words, " "));
}

// Patterns "COMMAND OPTION" of one option.
std::string bash_patterns(const CommandText& command, const OptionText& option) {
  std::vector<std::string> patterns;
  for (const std::string& name : option.names)
    patterns.push_back(fmt::format("\"{} {}\"", command.name, name));
  return fmt::format("{}", fmt::join(patterns, "|"));
}

// ---- zsh

std::string zsh_quoted(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
    if (c == '\'') result += "\\''";
  }
  return result;
}

std::string zsh_function(const std::string& command) {
  return "_phlux" + (command.empty() ? "" : "_" + replaced(command, " ", "_"));
}

// After the option's name: its value, if it takes one, and how it is completed.
std::string zsh_value(const OptionText& option) {
  if (option.value.empty()) return "";
  const std::string action = !option.choices.empty() ? fmt::format("({})", fmt::join(option.choices, " "))
                             : option.takes_file()   ? "_files"
                                                     : " ";
  return fmt::format(":{}:{}", zsh_quoted(option.value), action);
}

std::string zsh_options(const CommandText& command) {
  std::string text;
  for (const OptionText& option : command.options)
    for (const std::string& name : option.names)
      text += fmt::format(" \\\n    '*{}[{}]{}'", name, zsh_quoted(option.help), zsh_value(option));
  return text;
}

std::string zsh_commands(const CommandText& command, const std::vector<CommandText>& commands) {
  std::string list, cases;
  for (const std::string& name : command.commands) {
    const std::string full = command.name.empty() ? name : command.name + " " + name;
    const auto found = std::ranges::find(commands, full, &CommandText::name);
    list += fmt::format(" '{}:{}'", name, zsh_quoted(found->help));
    cases += fmt::format(" {}) {} ;;", name, zsh_function(full));
  }
  return fmt::format(" \\\n    '1: :->command' '*::argument:->arguments'\n"
                     "  case $state in\n"
                     "  command) local -a commands=({} ); _describe command commands ;;\n"
                     "  arguments) case $line[1] in{} esac ;;\n"
                     "  esac\n",
                     list, cases);
}

// ---- man

std::string troff(const std::string& text) {
  std::string result = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  if (result.starts_with('.') || result.starts_with('\'')) result.insert(0, "\\&");
  return replaced(replaced(result, "\n.", "\n\\&."), "\n'", "\n\\&'");
}

std::string man_option(const OptionText& option) {
  const std::string names = troff(fmt::format("{}", fmt::join(option.names, ", ")));
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", names,
                     option.value.empty() ? "" : fmt::format(" \\fI{}\\fR", troff(option.value)),
                     troff(option.help));
}

std::string man_options(const std::vector<OptionText>& options) {
  std::string text, group = "Options";
  for (const OptionText& option : options) {
    if (option.group != group && option.group != "Options")
      text += fmt::format(".PP\n{}:\n", troff(option.group));
    group = option.group;
    text += man_option(option);
  }
  return text;
}

std::string synopsis(const CommandText& command) {
  std::string text = fmt::format(".B phlux{}\n", command.name.empty() ? "" : " " + troff(command.name));
  text += command.commands.empty() ? "[\\fIoptions\\fR]" : "\\fIcommand\\fR";
  for (const OptionText& positional : command.positionals)
    text += fmt::format(" \\fI{}\\fR", troff(positional.names.front()));
  return text + "\n";
}

} // namespace

bool OptionText::takes_file() const {
  const std::size_t dot = value.rfind('.'); // FILE.exr, but not N,N,...
  return value == "FILE" || value == "DIR" || value == "FOLDER" ||
         (dot != std::string::npos && dot + 1 < value.size());
}

std::vector<CommandText> commands_of(const CLI::App& program) {
  std::vector<CommandText> commands;
  add(program, "", commands);
  return commands;
}

std::string bash_completion(const std::vector<CommandText>& commands) {
  std::string names, choices, words;
  for (const CommandText& command : commands) {
    if (!command.name.empty()) names += fmt::format("{}\"{}\"", names.empty() ? "" : "|", command.name);
    words += fmt::format("  \"{}\") words=\"{}\" ;;\n", command.name, bash_words(command));
    for (const OptionText& option : command.options)
      if (!option.value.empty())
        choices += fmt::format("  {}) COMPREPLY=($(compgen -W \"{}\" -- \"$current\")); return ;;\n",
                               bash_patterns(command, option), fmt::join(option.choices, " "));
  }
  return fmt::format(R"(# bash completion for phlux, written by `phlux completion bash`
_phlux() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} command= words= word
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "${{command:+$command }}$word" in
    {0}) command="${{command:+$command }}$word" ;;
    esac
  done
  COMPREPLY=() # empty: bash completes file names
  case "$command $previous" in
{1}  esac
  case $command in
{2}  esac
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}}
complete -o default -F _phlux phlux
)",
                     names, choices, words);
}

std::string zsh_completion(const std::vector<CommandText>& commands) {
  std::string text = "#compdef phlux\n# zsh completion for phlux, written by `phlux completion zsh`\n";
  for (const CommandText& command : commands) {
    text += fmt::format("{}() {{\n  local state line\n  _arguments -C{}", zsh_function(command.name),
                        zsh_options(command));
    text += command.commands.empty() ? " \\\n    '*:file:_files'\n" : zsh_commands(command, commands);
    text += "}\n";
  }
  return text + "_phlux \"$@\"\n";
}

std::string manual_page(const std::vector<CommandText>& commands) {
  const CommandText& program = commands.front();
  std::string text =
      fmt::format(".TH PHLUX 1 \"\" \"phlux {}\" \"User Commands\"\n.SH NAME\nphlux \\- {}\n.SH SYNOPSIS\n",
                  PHLUX_VERSION, troff(replaced(program.help, "phlux: ", "")));
  for (const CommandText& command : commands)
    if (command.commands.empty()) text += synopsis(command) + ".br\n";
  text += ".SH OPTIONS\n" + man_options(program.options);
  for (const CommandText& command : commands) {
    if (command.name.empty()) continue;
    text += fmt::format(".SH \"phlux {}\"\n{}\n", troff(command.name), troff(command.help));
    text += man_options(command.positionals) + man_options(command.options);
    if (command.footer.find_first_not_of(' ') != std::string::npos)
      text += ".PP\n" + troff(command.footer) + "\n";
  }
  return text + ".SH NOTES\n" + troff(program.footer) + "\n";
}

} // namespace phlux::cli
