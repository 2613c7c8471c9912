// The pages (*.md): their links, commands, messages and figures.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "cli/command_line.h"
#include "cli/program.h"
#include "errors.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;

const fs::path source = PHLUX_SOURCE_DIR;

std::vector<fs::path> pages() {
  std::vector<fs::path> found = {source / "README.md", source / "CONTRIBUTING.md", source / "CHANGELOG.md"};
  for (const char* folder : {"bench", "host", "kernels", "scenes", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(source / folder))
      if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

std::vector<std::string> lines_of(const fs::path& page) {
  std::istringstream stream(TemporaryFolder::read(page));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
  return text;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

std::vector<std::string> split(const std::string& text, const std::string& at) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = text.find(at, begin)) != std::string::npos; begin = end + at.size())
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

// ---- Links

// What GitHub makes of a heading: lower case, blanks as hyphens, without punctuation.
std::set<std::string> anchors_of(const fs::path& page) {
  std::set<std::string> anchors;
  for (const std::string& line : lines_of(page)) {
    if (!line.starts_with('#')) continue;
    std::string anchor;
    for (const char c : trimmed(line.substr(line.find_first_not_of('#')))) {
      if (c == ' ' || c == '-') anchor += '-';
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_')
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    anchors.insert(anchor);
  }
  return anchors;
}

// ---- Commands

// The lines of code blocks, with their continuations, and the texts between backticks.
std::vector<std::string> code_of(const fs::path& page) {
  std::vector<std::string> code;
  bool fenced = false, continues = false;
  for (const std::string& line : lines_of(page)) {
    if (line.starts_with("```")) {
      fenced = !fenced;
      continue;
    }
    const bool block = fenced || line.starts_with("    ");
    if (block && continues && trimmed(line).starts_with("--"))
      code.back() += " " + trimmed(line);
    else if (block)
      code.push_back(trimmed(line));
    continues = block && !code.back().empty();
    if (block) continue;
    const std::vector<std::string> parts = split(line, "`");
    for (std::size_t i = 1; i < parts.size(); i += 2) code.push_back(parts[i]);
  }
  return code;
}

// The words of a command of phlux, without its own name. Nothing for other texts, and for those that are no
// command as they stand: one word, NAMEs, [optional] words or an ellipsis.
std::optional<std::vector<std::string>> words_of(const std::string& code) {
  std::string text = code.starts_with("./") ? code.substr(2) : code;
  if (!text.starts_with("phlux ") || text.starts_with("phlux: ")) return std::nullopt;
  text = text.substr(0, std::min(text.find(" | "), text.find(" > ")));
  for (const char* mark :
       {"[", "...", "<", "NAME", "COMMAND", "--help", "--version", "KD,KS", "SPEC", "phlux test"})
    if (text.find(mark) != std::string::npos) return std::nullopt;
  for (const auto& [placeholder, value] : std::map<std::string, std::string>{
           {" N", " 4"}, {" SECONDS", " 1"}, {"X,Y,W,H", "0,0,1,1"}, {" EV", " 0"}, {" FOLDER", " folder"}})
    text = replaced(text, placeholder, value);
  std::vector<std::string> words;
  std::string word;
  bool quoted = false;
  for (const char c : text + " ") {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ' ' && !quoted) {
      if (!word.empty()) words.push_back(word);
      word.clear();
    } else {
      word += c;
    }
  }
  words.erase(words.begin());
  return words.size() > 1 ? std::optional(words) : std::nullopt;
}

// The same render with few samples and pixels.
std::vector<std::string> shortened(const std::vector<std::string>& words) {
  const std::set<std::string> amounts = {"-n", "--spp", "--time", "--error", "--size", "--crop"};
  std::vector<std::string> shorter;
  for (std::size_t i = 0; i < words.size(); ++i)
    if (amounts.contains(words[i]))
      ++i;
    else
      shorter.push_back(words[i]);
  shorter.insert(shorter.end(), {"--size", "24x16", "-n", "8"});
  return shorter;
}

// All but those that take long: bench and verify.
void check_commands_run(const fs::path& page) {
  const TemporaryFolder folder;
  fs::create_directory_symlink(source / "scenes", folder / "scenes");
  for (const std::string& code : code_of(page)) {
    const auto words = words_of(code);
    if (!words || (*words)[0] == "bench" || (*words)[0] == "verify") continue;
    const Outcome outcome =
        run({(*words)[0] == "render" ? shortened(*words) : *words, folder.path(), {}, {}});
    CAPTURE(page, code, outcome.err);
    CHECK(outcome.exit_code == 0);
  }
}

class InFolder { // while it lives
public:
  explicit InFolder(const fs::path& folder) : before_(fs::current_path()) { fs::current_path(folder); }
  ~InFolder() { fs::current_path(before_); }
  InFolder(const InFolder&) = delete;
  InFolder& operator=(const InFolder&) = delete;

private:
  fs::path before_;
};

// ---- Tables

struct Table {
  std::vector<std::vector<std::string>> rows;
  std::map<std::string, std::size_t> columns;

  [[nodiscard]] const std::string& at(std::size_t row, const std::string& column) const {
    return rows[row].at(columns.at(column));
  }
  [[nodiscard]] double number(std::size_t row, const std::string& column) const {
    return at(row, column).empty() ? NAN : std::stod(at(row, column));
  }
  [[nodiscard]] std::string method(std::size_t row) const {
    return trimmed(replaced(at(row, "integrator") + " " + at(row, "connect_or_weights"), " -", ""));
  }
};

std::vector<std::string> cells_of_csv(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

Table saved(const std::string& name) {
  Table table;
  for (const std::string& line : lines_of(source / "bench/saved" / name))
    table.rows.push_back(cells_of_csv(line));
  for (std::size_t i = 0; i < table.rows[0].size(); ++i) table.columns[table.rows[0][i]] = i;
  table.rows.erase(table.rows.begin());
  return table;
}

// The cells of the row of a page's table that begins with `first`.
std::vector<std::string> row_of(const std::string& page, const std::string& first) {
  for (const std::string& line : lines_of(source / "bench" / page)) {
    if (!line.starts_with("| " + first + " |")) continue;
    std::vector<std::string> cells;
    for (const std::string& cell : split(line, "|")) cells.push_back(trimmed(cell));
    return cells;
  }
  FAIL(page << " has no row " << first);
  return {};
}

double number_in(const std::string& cell) {
  std::string digits;
  for (const char c : cell)
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.')
      digits += c;
    else if (c == ' ' && !digits.empty())
      break;
  return digits.empty() ? NAN : std::stod(digits);
}

} // namespace

TEST_CASE("Every link of the pages leads to a file and a heading") {
  for (const fs::path& page : pages())
    for (const std::string& line : lines_of(page)) {
      const std::vector<std::string> parts = split(line, "](");
      for (std::size_t i = 1; i < parts.size(); ++i) {
        const std::string link = parts[i].substr(0, parts[i].find(')'));
        if (link.starts_with("http")) continue;
        const std::string file = link.substr(0, link.find('#'));
        const fs::path target = file.empty() ? page : page.parent_path() / file;
        CAPTURE(page, link);
        CHECK(fs::exists(target));
        if (file.size() < link.size() && fs::exists(target))
          CHECK(anchors_of(target).contains(link.substr(file.size() + 1)));
      }
    }
}

TEST_CASE("The command line accepts every command of the pages") {
  const InFolder here(source);
  int commands = 0;
  for (const fs::path& page : pages())
    for (const std::string& code : code_of(page))
      if (auto words = words_of(code); words && page.filename() != "CHANGELOG.md") {
        ++commands;
        words->insert(words->begin(), "phlux");
        std::vector<char*> arguments;
        for (std::string& word : *words) arguments.push_back(word.data());
        CAPTURE(page, code);
        try {
          static_cast<void>(phlux::cli::parse(static_cast<int>(arguments.size()), arguments.data()));
        } catch (const phlux::Error& error) {
          FAIL_CHECK(error.what());
        }
      }
  CHECK(commands > 80);
}

TEST_CASE("The commands of the cookbook run, with fewer samples") {
  check_commands_run(source / "scenes/COOKBOOK.md");
}

TEST_CASE("The commands of the exercises run, with fewer samples", "[.long]") {
  check_commands_run(source / "scenes/EXERCISES.md");
}

TEST_CASE("The messages of the page on troubleshooting are those of the program") {
  std::string texts;
  for (const auto& entry : fs::recursive_directory_iterator(source / "host"))
    if (entry.path().extension() == ".cpp") texts += TemporaryFolder::read(entry.path());
  for (const auto& entry : fs::recursive_directory_iterator(source / "bench"))
    if (entry.path().extension() == ".cpp") texts += TemporaryFolder::read(entry.path());
  std::string joined; // literals that follow each other are one
  for (std::size_t at = 0; at < texts.size(); ++at) {
    const std::size_t next = texts[at] == '"' ? texts.find_first_not_of(" \n", at + 1) : std::string::npos;
    if (next != std::string::npos && next > at + 1 && texts[next] == '"')
      at = next;
    else
      joined += texts[at];
  }
  int messages = 0;
  for (const std::string& line : lines_of(source / "host/TROUBLESHOOTING.md")) {
    if (!line.starts_with("| `")) continue;
    const std::string message = split(line, "`").at(1);
    for (const std::string& piece : split(message, "...")) {
      CAPTURE(message, piece);
      CHECK(joined.find(replaced(trimmed(piece), "--", "")) != std::string::npos);
    }
    ++messages;
  }
  CHECK(messages > 20);
}

TEST_CASE("Times in the report of scenes are those of its table") {
  const Table table = saved("scenes.csv");
  const std::vector<std::string> methods = {"path none",     "path light",  "path mis",     "light",
                                            "bidir balance", "bidir power", "bidir uniform"};
  std::map<std::string, std::map<std::string, double>> times;
  std::map<std::string, double> best;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& scene = table.at(row, "scene");
    const double time =
        table.number(row, "variance_measured") * table.number(row, "processor_seconds_per_sample");
    times[scene][table.method(row)] = time;
    if (table.at(row, "verdict") != "sound") continue;
    best[scene] = best.contains(scene) ? std::min(best[scene], time) : time;
  }
  CHECK(times.size() == 8);
  for (const auto& [scene, of_methods] : times) {
    const std::vector<std::string> cells = row_of("saved/REPORT.md", scene);
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const double stated = number_in(cells.at(i + 2));
      if (std::isnan(stated)) continue; // refused
      CAPTURE(scene, methods[i]);
      CHECK(stated == Approx(of_methods.at(methods[i]) / best[scene]).epsilon(0.025)); // two digits or more
    }
  }
}

TEST_CASE("Counts in the report of stability are those of its table") {
  const Table table = saved("stability.csv");
  std::map<std::string, std::array<int, 3>> sound;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (table.at(row, "verdict") != "sound") continue;
    const double exponent = table.number(row, "exponent");
    auto& counts = sound[table.method(row)];
    ++counts[0];
    counts[1] += exponent <= 100 ? 1 : 0;
    counts[2] += exponent >= 1000 ? 1 : 0;
  }
  CHECK(sound.size() == 7);
  for (const auto& [method, counts] : sound) {
    const std::vector<std::string> cells = row_of("saved/STABILITY.md", method);
    CAPTURE(method);
    for (std::size_t i = 0; i < counts.size(); ++i) CHECK(number_in(cells.at(i + 2)) == counts[i]);
  }
}

TEST_CASE("Means in the pages on roulette are those of the table") {
  const Table table = saved("roulette.csv");
  std::map<std::string, std::vector<double>> logarithms;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    logarithms[table.at(row, "roulette") + table.at(row, "integrator") + table.at(row, "rr_depth")].push_back(
        std::log(table.number(row, "ratio")));
  const auto check = [&](const std::string& page, const std::string& name, std::size_t first) {
    const std::vector<std::string> cells = row_of(page, "`" + name + "`");
    std::size_t column = first;
    for (const char* integrator : {"bidir", "path"})
      for (const char* depth : {"5", "1"}) {
        const std::vector<double>& all = logarithms.at(name + integrator + depth);
        double sum = 0.0;
        for (const double one : all) sum += one;
        CAPTURE(page, name, integrator, depth);
        CHECK(number_in(cells.at(column++)) ==
              Approx(std::exp(sum / static_cast<double>(all.size()))).margin(6e-3));
      }
  };
  for (const char* name : {"kd-ks", "throughput", "efficiency"}) {
    check("saved/ROULETTE.md", name, 2);
    check("CHOOSING.md", name, 3);
  }
}
