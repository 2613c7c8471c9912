// The pages (*.md): their links, commands and messages.
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
#include "cli/page_text.h"
#include "cli/program.h"
#include "errors.h"
#include "temporary_folder.h"

using namespace phlux::test;

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> pages() {
  std::vector<fs::path> found = {source / "README.md", source / "CONTRIBUTING.md", source / "CHANGELOG.md"};
  for (const char* folder : {"bench", "host", "kernels", "scenes", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(source / folder))
      if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
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
// command of the program as they stand: one word, NAMEs, [optional] words, an ellipsis, or a command of the
// launcher.
std::optional<std::vector<std::string>> words_of(const std::string& code) {
  std::string text = code.starts_with("./") ? code.substr(2) : code;
  if (!text.starts_with("phlux ") || text.starts_with("phlux: ")) return std::nullopt;
  text = text.substr(0, std::min(text.find(" | "), text.find(" > ")));
  for (const char* mark : {"[", "...", "<", "NAME", "COMMAND", "--help", "--version", "KD,KS", "SPEC",
                           "phlux test", "phlux bundle"})
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

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

// Runs commands of pages in a folder with the files that they name.
class Reader {
public:
  Reader() {
    for (const char* name : {"scenes", "kernels"})
      fs::create_directory_symlink(source / name, folder_ / name);
    fs::copy_file(source / "scenes/cornell-box.xml", folder_ / "SCENE.xml");
    for (const char* seed : {"0", "1"})
      run_words(shortened({"render", "SCENE.xml", "--seed", seed, "-o", *seed == '0' ? "A.exr" : "B.exr"}));
    for (const char* copy : {"a.exr", "FILE.exr"}) fs::copy_file(folder_ / "A.exr", folder_ / copy);
    fs::copy_file(folder_ / "B.exr", folder_ / "reference.exr");
  }

  /// Each command once, but for those that take long (bench, verify) or need a GPU or a viewer.
  void try_all(const fs::path& page) {
    for (const std::string& code : code_of(page)) {
      const auto words = words_of(code);
      if (!words || has(*words, "bench") || has(*words, "verify") || has(*words, "gpu")) continue;
      if (has(*words, "view") && !has(*words, "--png")) continue;
      CAPTURE(page, code);
      run_words(has(*words, "render") ? shortened(*words) : *words);
    }
  }

private:
  void run_words(const std::vector<std::string>& words) {
    if (!done_.insert(words).second) return;
    const Outcome outcome = run({words, folder_.path(), {}, {}});
    CAPTURE(words, outcome.err);
    CHECK((outcome.exit_code == 0 || (outcome.exit_code == 1 && has(words, "--fail-above"))));
  }

  TemporaryFolder folder_;
  std::set<std::vector<std::string>> done_;
};

class InFolder { // while it lives
public:
  explicit InFolder(const fs::path& folder) : before_(fs::current_path()) { fs::current_path(folder); }
  ~InFolder() { fs::current_path(before_); }
  InFolder(const InFolder&) = delete;
  InFolder& operator=(const InFolder&) = delete;

private:
  fs::path before_;
};

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

TEST_CASE("The commands of the pages run, with few samples") {
  Reader reader;
  for (const fs::path& page : pages())
    if (page.filename() != "CHANGELOG.md") reader.try_all(page);
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
