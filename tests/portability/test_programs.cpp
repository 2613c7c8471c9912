// Checks that the programs compiled for other devices cover all of kernels/.
#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

#include <catch2/catch.hpp>

#include "device/program.h"
#include "portability/programs.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::test;

namespace {

using Names = std::set<std::string>;

const std::filesystem::path kernels = PHLUX_SOURCE_DIR "/kernels";

// All matches of the only group of `pattern`.
Names found_in(const std::string& text, const std::regex& pattern) {
  Names names;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    names.insert((*match)[1]);
  return names;
}

Names without(const Names& all, const Names& some) {
  Names rest;
  std::ranges::set_difference(all, some, std::inserter(rest, rest.end()));
  return rest;
}

// Texts of the kernel files by their path in kernels/.
Names kernel_files() {
  Names names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kernels))
    if (entry.path().extension() == ".cl" || entry.path().extension() == ".h")
      names.insert(std::filesystem::relative(entry.path(), kernels));
  return names;
}

Names union_over_programs(const std::function<Names(const Program&)>& names_of) {
  Names all;
  for (const Program& program : programs()) all.merge(names_of(program));
  return all;
}

// Macros that are defined as 0 or as 1.
Names defined_as(const std::string& value, const Program& program) {
  Names names;
  for (const auto& [macro, defined] : program.source.defines)
    if (defined == value) names.insert(macro);
  return names;
}

} // namespace

TEST_CASE("portability: every part is on in one program and off in another") {
  for (const std::string& part : all_parts()) {
    CAPTURE(part);
    std::size_t on = 0;
    for (const SceneProgram& scene : scene_programs()) {
      const std::vector<std::string> names = scene.parts.names();
      on += static_cast<std::size_t>(std::ranges::count(names, part));
    }
    CHECK(on > 0);
    CHECK(on < scene_programs().size());
  }
}

TEST_CASE("portability: every switch of the kernels is on in one program and off in another") {
  const Names on = union_over_programs([](const Program& program) { return defined_as("1", program); });
  Names off = union_over_programs([](const Program& program) { return defined_as("0", program); });
  off.insert({"WIDTH", "PHLUX_DOUBLE", "PHLUX_NATIVE", "MODEL_COUNT"}); // not 0, but undefined or a number
  CHECK(without(off, on) == Names{"CONNECTIONS"});                      // how many
  CHECK(without(on, off) == Names{});
}

// Macros that the host defines only if they are on are named PHLUX_...
TEST_CASE(
    "portability: every macro that the host may define for kernels is defined in at least one program") {
  std::string text;
  for (const std::string& file : kernel_files()) text += TemporaryFolder::read(kernels / file);
  const Names used = found_in(text, std::regex(R"(\b(PHLUX_[A-Z0-9_]+)\b)"));
  const Names defined_in_kernels = found_in(text, std::regex(R"(#\s*define\s+(\w+))"));
  const Names defined_by_programs = union_over_programs([](const Program& program) {
    Names names;
    for (const auto& [macro, value] : program.source.defines) names.insert(macro);
    return names;
  });
  CHECK(without(without(used, defined_in_kernels), defined_by_programs) == Names{});
}

TEST_CASE("portability: every kernel file is in some program") {
  const Names included = union_over_programs([](const Program& program) {
    return found_in(device::expand({}, program.source), std::regex(R"r(#line \d+ "([^"]+)")r"));
  });
  CHECK(without(kernel_files(), included) == Names{});
}

TEST_CASE("portability: no two programs share a name") {
  Names names;
  for (const Program& program : programs()) {
    CAPTURE(program.name);
    CHECK(names.insert(program.name).second);
  }
}
