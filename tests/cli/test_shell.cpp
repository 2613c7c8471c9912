// Completion in bash and the manual page.
#include <cstdlib>

#include <catch2/catch.hpp>

#include "cli/program.h"
#include "temporary_folder.h"

namespace {

std::string out_of(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  const Outcome outcome = run({arguments, folder.path(), {}, {}});
  REQUIRE(outcome.exit_code == 0);
  return outcome.out;
}

// What bash offers for the last of the words.
std::string offered(const std::string& words, const TemporaryFolder& folder) {
  folder.write("ask.sh", "set -u\nsource ./completion.sh\nCOMP_WORDS=(" + words +
                             ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_phlux\necho \"${COMPREPLY[*]-}\"\n");
  const std::string command = "cd '" + folder.path().string() + "' && bash ask.sh > offered 2>&1";
  REQUIRE(std::system(command.c_str()) == 0);
  return TemporaryFolder::read(folder / "offered");
}

} // namespace

TEST_CASE("bash completes commands, options and names that are values") {
  const TemporaryFolder folder;
  folder.write("completion.sh", out_of({"completion", "bash"}, folder));
  CHECK(offered("phlux re", folder) == "render\n");
  CHECK(offered("phlux bench sc", folder) == "scenes\n");
  CHECK(offered("phlux render scene.xml --integ", folder) == "--integrator\n");
  CHECK(offered("phlux render --integrator ''", folder) == "path light bidir auto\n");
  CHECK(offered("phlux render -i b", folder) == "bidir\n");
  CHECK(offered("phlux verify --strategy lobe-e", folder) == "lobe-estimate-printed lobe-estimate\n");
  CHECK(offered("phlux bench scenes --qu", folder) == "--quick\n");
  CHECK(offered("phlux render --output ''", folder) == "\n"); // file names, by bash
}

TEST_CASE("zsh's script names every command") {
  const TemporaryFolder folder;
  const std::string script = out_of({"completion", "zsh"}, folder);
  CHECK_THAT(script, Catch::StartsWith("#compdef phlux\n"));
  for (const char* name :
       {"_phlux_render() {", "_phlux_bench_scenes() {", "'*--integrator[", ":(path light bidir auto)'"})
    CHECK_THAT(script, Catch::Contains(name));
}

TEST_CASE("The manual page has every command and option, and troff accepts it") {
  const TemporaryFolder folder;
  const std::string page = out_of({"man"}, folder);
  CHECK_THAT(page, Catch::StartsWith(".TH PHLUX 1 "));
  for (const char* text : {".SH \"phlux render\"", ".SH \"phlux bench scenes\"",
                           "\\fB\\-i, \\-\\-integrator\\fR \\fINAME\\fR", "130 interrupted"})
    CHECK_THAT(page, Catch::Contains(text));
  folder.write("phlux.1", page);
  if (std::system("command -v groff > /dev/null") != 0) return;
  const std::string command =
      "cd '" + folder.path().string() + "' && groff -man -Tutf8 -ww -z phlux.1 > warnings 2>&1";
  CHECK(std::system(command.c_str()) == 0);
  CHECK(TemporaryFolder::read(folder / "warnings").empty());
}
