// Files with a bit flipped or cut off: refused, or read right. "[.damage]" takes an hour.
#include <iostream>
#include <map>
#include <random>

#include <catch2/catch.hpp>

#include "cli/workplace.h"
#include "repetitions.h"

namespace fs = std::filesystem;

namespace {

// Flips one bit, or cuts the bytes off.
std::string damaged(std::string bytes, std::mt19937& random) {
  const std::size_t place = random() % bytes.size();
  if (random() % 2 == 0)
    bytes.resize(place);
  else
    bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
  return bytes;
}

struct Damage : Workplace {
  // PHLUX_DAMAGE_SEED: other damages.
  std::mt19937 random{static_cast<std::mt19937::result_type>(repetitions("PHLUX_DAMAGE_SEED", 1))};
  Outcome render(std::vector<std::string> arguments, const fs::path& cache) const {
    arguments.insert(arguments.begin(), {"render", "scene.xml", "-q", "--png", "none"});
    return run(
        {arguments, path(), {{"POCL_CACHE_DIR", cache / "pocl"}, {"PHLUX_CACHE_DIR", cache / "phlux"}}, {}});
  }
};

void print(const char* what, const std::map<std::string, int>& outcomes) {
  std::cout << what << ':';
  for (const auto& [outcome, count] : outcomes) std::cout << ' ' << outcome << ' ' << count;
  std::cout << '\n';
}

} // namespace

TEST_CASE("Damaged kernel caches give the right image", "[.damage]") {
  Damage place;
  const fs::path whole = place / "whole", cache = place / "cache";
  REQUIRE(place.render({"-n", "16", "-o", "right.exr"}, whole).exit_code == 0);
  const auto right = place.image("right.exr").channels;
  std::vector<fs::path> files; // relative
  for (const auto& entry : fs::recursive_directory_iterator(whole))
    if (entry.is_regular_file() && entry.file_size() > 0)
      files.push_back(entry.path().lexically_relative(whole));
  std::map<std::string, int> outcomes;
  for (int i = 0; i < repetitions("PHLUX_DAMAGED_CACHES", 1000); ++i) {
    fs::remove_all(cache);
    fs::copy(whole, cache, fs::copy_options::recursive);
    const fs::path file = cache / files[place.random() % files.size()];
    place.write("bytes", damaged(TemporaryFolder::read(file), place.random));
    fs::permissions(file, fs::perms::owner_all);
    const fs::file_time_type time = fs::last_write_time(file);
    fs::copy_file(place / "bytes", file, fs::copy_options::overwrite_existing);
    fs::last_write_time(file, time);
    const Outcome outcome = place.render({"-n", "16"}, cache);
    CAPTURE(i, file, outcome.err);
    CHECK(outcome.exit_code == 0);
    const bool same = place.image().channels == right;
    CHECK(same);
    ++outcomes[outcome.exit_code != 0 ? "exit " + std::to_string(outcome.exit_code)
               : same                 ? "right"
                                      : "wrong"];
  }
  print("caches", outcomes);
}

TEST_CASE("Damaged checkpoints are refused, or resume to the right image", "[.damage]") {
  Damage place;
  const fs::path cache = place / "cache";
  REQUIRE(place.render({"-n", "16", "-i", "bidir", "--checkpoint", "c"}, cache).exit_code == 0);
  REQUIRE(place.render({"-n", "32", "-i", "bidir", "-o", "right.exr"}, cache).exit_code == 0);
  const auto right = place.image("right.exr").channels;
  const std::string bytes = TemporaryFolder::read(place / "c");
  std::map<std::string, int> outcomes;
  for (int i = 0; i < repetitions("PHLUX_DAMAGED_CHECKPOINTS", 1000); ++i) {
    place.write("d", damaged(bytes, place.random));
    const Outcome outcome =
        place.render({"-n", "32", "--resume", "d", "--checkpoint", "none", "-o", "on.exr"}, cache);
    CAPTURE(i, outcome.err);
    const bool refused = outcome.exit_code == 3 && outcome.is_one_line_error();
    const bool same = outcome.exit_code == 0 && place.image("on.exr").channels == right;
    CHECK((refused || same));
    ++outcomes[refused ? "refused" : same ? "right" : "exit " + std::to_string(outcome.exit_code)];
  }
  print("checkpoints", outcomes);
}
