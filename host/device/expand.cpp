#include "device/program.h"

#include <set>
#include <sstream>

#include <fmt/format.h>

#include "errors.h"

namespace phlux::device {

namespace {

constexpr const char* blanks = " \t\r";

// The directive's text after '#', without blanks before it; empty when the line is no directive.
std::string directive(const std::string& line) {
  auto at = line.find_first_not_of(blanks);
  if (at == std::string::npos || line[at] != '#') return {};
  at = line.find_first_not_of(blanks, at + 1);
  return at == std::string::npos ? std::string() : line.substr(at);
}

// The file that `#include "file"` names; empty for every other line.
std::string included_file(const std::string& line) {
  const std::string text = directive(line);
  if (text.rfind("include", 0) != 0) return {};
  const auto open = text.find_first_not_of(blanks, 7);
  if (open == std::string::npos || text[open] != '"') return {};
  const auto close = text.find('"', open + 1);
  return close == std::string::npos ? std::string() : text.substr(open + 1, close - open - 1);
}

class Expansion {
public:
  explicit Expansion(const KernelFiles& files) : files_(files) {}

  void define(const std::string& name, const std::string& value) {
    text_ += fmt::format("#define {} {}\n", name, value);
  }

  void add_file(const std::string& name) {
    if (seen_.insert(name).second) add_text(name, files_.read(name));
  }

  void add_text(const std::string& name, const std::string& text) {
    tag(1, name);
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      if (const std::string file = included_file(line); !file.empty())
        include(file, name, number);
      else if (directive(line) == "pragma once")
        text_ += '\n';
      else
        text_ += line + '\n';
    }
  }

  [[nodiscard]] std::string text() && { return std::move(text_); }

private:
  void include(const std::string& file, const std::string& from, int line) {
    if (seen_.count(file) != 0) {
      text_ += '\n';
      return;
    }
    try {
      add_file(file);
    } catch (const DeviceError& error) {
      if (nested_) throw;
      nested_ = true; // the innermost #include is the one to blame
      throw DeviceError(fmt::format("{}:{}: {}", from, line, error.what()));
    }
    tag(line + 1, from);
  }

  void tag(int line, const std::string& file) { text_ += fmt::format("#line {} \"{}\"\n", line, file); }

  const KernelFiles& files_;
  std::set<std::string> seen_;
  bool nested_ = false;
  std::string text_;
};

} // namespace

std::string expand(const KernelFiles& files, const ProgramSource& source) {
  Expansion expansion(files);
  for (const auto& [name, value] : source.defines) expansion.define(name, value);
  if (!source.root.empty()) expansion.add_file(source.root);
  if (!source.extra.empty()) expansion.add_text("extra", source.extra);
  return std::move(expansion).text();
}

} // namespace phlux::device
