#include "device/program.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "device/condition.h"
#include "errors.h"

namespace phlux::device {

namespace {

constexpr const char* blanks = " \t\r";

// A line of a kernel file with those that backslashes join to it.
struct Line {
  int number = 1;            // of the first
  std::string text;          // as in the file, with newlines
  std::string keyword, rest; // of a directive: `if`, `A && B`, without comments; else empty
};

// Takes comments out of one line; `inside` says whether a block comment is open before and after it.
std::string without_comments(const std::string& line, bool& inside) {
  std::string kept;
  char quote = '\0';
  for (std::size_t at = 0; at < line.size(); ++at) {
    const auto two = line.substr(at, 2);
    if (inside) {
      if (two == "*/") {
        inside = false;
        ++at;
        kept += ' ';
      }
    } else if (quote != '\0') {
      kept += line[at];
      if (line[at] == '\\' && at + 1 < line.size())
        kept += line[++at];
      else if (line[at] == quote)
        quote = '\0';
    } else if (two == "//") {
      break;
    } else if (two == "/*") {
      inside = true;
      ++at;
    } else {
      if (line[at] == '"' || line[at] == '\'') quote = line[at];
      kept += line[at];
    }
  }
  return kept;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::size_t name_length(const std::string& text) {
  std::size_t length = 0;
  while (length < text.size() &&
         (std::isalnum(static_cast<unsigned char>(text[length])) != 0 || text[length] == '_'))
    ++length;
  return length;
}

std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream stream(text);
  bool inside_comment = false;
  int number = 0;
  for (std::string physical; std::getline(stream, physical);) {
    Line line;
    line.number = ++number;
    line.text = physical + '\n';
    std::string logical = physical;
    while (!logical.empty() && logical.back() == '\\' && std::getline(stream, physical)) {
      ++number;
      line.text += physical + '\n';
      logical.back() = ' ';
      logical += physical;
    }
    std::string code = trimmed(without_comments(logical, inside_comment));
    if (!code.empty() && code[0] == '#') {
      code = trimmed(code.substr(1));
      const auto length = name_length(code);
      line.keyword = code.substr(0, length);
      line.rest = trimmed(code.substr(length));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

// Expands one program. Branches of #if that the defines rule out are left out; a condition that only the
// compiler can decide stays, with both of its branches.
class Expansion {
public:
  explicit Expansion(const KernelFiles& files) : files_(files) {}

  void define(const std::string& name, const std::string& value) {
    text_ += fmt::format("#define {} {}\n", name, value);
    macros_.define(name, value);
  }

  void add_file(const std::string& name) {
    if (seen_.count(name) != 0) return;
    const std::string text = files_.read(name);
    // Where the compiler decides whether this is read at all, a later #include must bring it again.
    if (certain()) seen_.insert(name);
    add_text(name, text);
  }

  void add_text(const std::string& name, const std::string& text) {
    const std::string outer = std::exchange(file_, name);
    const std::size_t depth = groups_.size();
    if (++nesting_ > deepest_nesting) throw DeviceError(fmt::format("{}: includes itself", name));
    gap_ = true;
    for (const Line& line : lines_of(text)) add_line(line, depth);
    if (groups_.size() != depth) throw DeviceError(fmt::format("{}: #if without #endif", name));
    --nesting_;
    file_ = outer;
    gap_ = true;
  }

  [[nodiscard]] std::string text() && { return std::move(text_); }

private:
  static constexpr int deepest_nesting = 64;

  // An #if and its #elif and #else.
  struct Group {
    bool possible;                      // what surrounds it is kept
    bool certain_around;                // and is so whatever the compiler decides
    bool decided = false;               // an earlier branch is known to be the one
    bool in_text = false;               // an #if of it was written, so its #endif must be
    bool kept = false, certain = false; // the present branch
  };

  [[nodiscard]] bool kept() const { return groups_.empty() || groups_.back().kept; }
  [[nodiscard]] bool certain() const { return groups_.empty() || groups_.back().certain; }

  void add_line(const Line& line, std::size_t outermost) {
    const auto& keyword = line.keyword;
    if (keyword == "if" || keyword == "ifdef" || keyword == "ifndef") {
      groups_.push_back({kept(), certain()});
      begin_branch(line, kept_truth(line));
    } else if ((keyword == "elif" || keyword == "else" || keyword == "endif") && groups_.size() > outermost) {
      if (keyword == "endif")
        end_group(line);
      else
        begin_branch(line, keyword == "else" ? std::optional(true) : kept_truth(line));
    } else if (!kept() || (keyword == "pragma" && line.rest == "once")) {
      gap_ = true;
    } else if (keyword == "include" && line.rest.size() > 2 && line.rest[0] == '"') {
      include(line.rest.substr(1, line.rest.find('"', 1) - 1), line.number);
    } else {
      if (keyword == "define" || keyword == "undef") note_macro(line);
      write(line, line.text);
    }
  }

  [[nodiscard]] std::optional<bool> kept_truth(const Line& line) const {
    if (!groups_.back().possible) return false;
    if (line.keyword == "ifdef") return macros_.defined(line.rest);
    if (line.keyword == "ifndef") {
      const auto defined = macros_.defined(line.rest);
      return defined ? std::optional(!*defined) : std::nullopt;
    }
    return evaluate(line.rest, macros_);
  }

  // truth: of this branch's own condition.
  void begin_branch(const Line& line, std::optional<bool> truth) {
    Group& group = groups_.back();
    gap_ = true;
    group.kept = group.possible && !group.decided && truth != false;
    group.certain = group.kept && group.certain_around && !group.in_text && truth == true;
    if (!group.kept) return;
    group.decided = truth == true;
    if (truth == true) {
      if (group.in_text) write(line, "#else\n");
    } else if (group.in_text) {
      write(line, line.text);
    } else {
      write(line, line.keyword == "elif" ? fmt::format("#if {}\n", line.rest) : line.text);
      group.in_text = true;
    }
  }

  void end_group(const Line& line) {
    gap_ = true;
    if (groups_.back().in_text) write(line, "#endif\n");
    groups_.pop_back();
  }

  void note_macro(const Line& line) {
    const auto length = name_length(line.rest);
    const std::string name = line.rest.substr(0, length);
    if (!certain())
      macros_.forget(name);
    else if (line.keyword == "undef")
      macros_.undefine(name);
    else if (length < line.rest.size() && line.rest[length] == '(')
      macros_.define_opaque(name);
    else
      macros_.define(name, trimmed(line.rest.substr(length)));
  }

  void include(const std::string& name, int line) {
    try {
      add_file(name);
    } catch (const DeviceError& error) {
      if (blamed_) throw;
      blamed_ = true; // the innermost #include
      throw DeviceError(fmt::format("{}:{}: {}", file_, line, error.what()));
    }
    gap_ = true;
  }

  void write(const Line& line, const std::string& text) {
    if (gap_) text_ += fmt::format("#line {} \"{}\"\n", line.number, file_);
    text_ += text;
    gap_ = std::count(text.begin(), text.end(), '\n') != std::count(line.text.begin(), line.text.end(), '\n');
  }

  const KernelFiles& files_;
  Macros macros_;
  std::set<std::string> seen_;
  std::vector<Group> groups_;
  std::string file_, text_;
  bool gap_ = true; // the next line written does not follow the last one in the same file
  bool blamed_ = false;
  int nesting_ = 0;
};

} // namespace

std::string expand(const KernelFiles& files, const ProgramSource& source) {
  Expansion expansion(files);
  for (const auto& [name, value] : source.defines) expansion.define(name, value);
  if (!source.root.empty()) expansion.add_file(source.root);
  if (!source.extra.empty()) expansion.add_text("extra", source.extra);
  return std::move(expansion).text();
}

std::string significant(const std::string& text) {
  std::string kept;
  bool continued = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::string code = trimmed(line);
    if (!continued && (code.empty() || code.rfind("//", 0) == 0 || code.rfind("#line ", 0) == 0)) continue;
    continued = !line.empty() && line.back() == '\\';
    kept += line + '\n';
  }
  return kept;
}

} // namespace phlux::device
