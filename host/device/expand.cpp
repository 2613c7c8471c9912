#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "device/program.h"
#include "device/users_files.h"
#include "errors.h"

namespace phlux::device {

namespace {

// Whether a block comment is open after `line`; `open`: before it.
bool leaves_comment_open(const std::string& line, bool open) {
  for (std::size_t at = 0; at < line.size(); ++at) {
    const auto two = line.compare(at, 2, "*/") == 0   ? 'e'
                     : line.compare(at, 2, "/*") == 0 ? 'b'
                     : line.compare(at, 2, "//") == 0 ? 'l'
                                                      : ' ';
    if (!open && two == 'l') return false;
    if (two != (open ? 'e' : 'b')) continue;
    open = !open;
    ++at;
  }
  return open;
}

class Expansion {
public:
  Expansion(const sources::KernelFiles& files, const ProgramSource& source) : files_(files), source_(source) {
    for (const auto& [name, value] : source.defines) text_ += fmt::format("#define {} {}\n", name, value);
  }

  void add_file(const std::string& name) {
    if (!seen_.insert(name).second) return;
    const auto own = source_.files.find(name);
    add_text(name, own != source_.files.end() ? own->second : files_.read(name));
  }

  void add_text(const std::string& name, const std::string& text) {
    static const std::regex include(R"re(\s*#\s*include\s*(?:"([^"]+)"|(\w+)).*)re");
    std::istringstream lines(text);
    bool tagged = false, in_comment = false;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      std::smatch found;
      if (!in_comment && line.find('#') != std::string::npos && std::regex_match(line, found, include)) {
        add_included(found, name, number);
        tagged = false;
        continue;
      }
      in_comment = leaves_comment_open(line, in_comment);
      if (!tagged) text_ += fmt::format("#line {} \"{}\"\n", number, name);
      tagged = true;
      text_ += line + '\n';
    }
  }

  [[nodiscard]] std::string text() && { return std::move(text_); }

private:
  // The file name that is the value of a define, such as PHONG_STRATEGY.
  [[nodiscard]] std::string included_by(const std::string& macro) const {
    const auto value = source_.defines.find(macro);
    if (value == source_.defines.end() || value->second.size() < 2)
      throw DeviceError(fmt::format("#include {}: it is not defined", macro));
    return value->second.substr(1, value->second.size() - 2); // without its quotes
  }

  void add_included(const std::smatch& include, const std::string& file, int line) {
    try {
      add_file(include[1].matched ? include[1].str() : included_by(include[2]));
    } catch (const DeviceError& error) {
      if (blamed_) throw;
      blamed_ = true; // the innermost #include is reported
      const std::string text = fmt::format("{}:{}: {}", file, line, error.what());
      if (is_users_file(source_, file)) throw FileError(text);
      throw DeviceError(text);
    }
  }

  const sources::KernelFiles& files_;
  const ProgramSource& source_;
  std::set<std::string> seen_;
  std::string text_;
  bool blamed_ = false;
};

} // namespace

std::string expand(const sources::KernelFiles& files, const ProgramSource& source) {
  Expansion expansion(files, source);
  if (!source.root.empty()) expansion.add_file(source.root);
  if (!source.extra.empty()) expansion.add_text("extra", source.extra);
  return std::move(expansion).text();
}

std::string significant(const std::string& text) {
  std::string kept;
  bool continued = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find_first_not_of(" \t\r");
    const std::string code = first == std::string::npos ? "" : line.substr(first);
    if (!continued && (code.empty() || code.rfind("//", 0) == 0 || code.rfind("#line ", 0) == 0)) continue;
    continued = !line.empty() && line.back() == '\\';
    kept += line + '\n';
  }
  return kept;
}

} // namespace phlux::device
