// As many random scenes as PHLUX_RANDOM_SCENES says (2000), 40 of each family, by 4 methods each:
//   PHLUX_RANDOM_TABLE=outcomes.csv test_random_scenes "[.long]"
// The table has a line for each pair of methods. An interrupted run continues after the last complete scene.
// PHLUX_RANDOM_ONLY="18-8 4-33" names the scenes instead. most_excused() limits the excused pairs, unless
// scenes are named, which may have been chosen by their results.
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <mutex>
#include <set>
#include <sstream>
#include <thread>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "random/agreement_of_methods.h"
#include "random/random_scene.h"
#include "random/twin.h"

using namespace phlux::test;

namespace {

constexpr std::uint64_t members = 40;
constexpr int methods = 4, samples_per_pixel = 32;
// Limits on processor time, which excludes other programs, and on elapsed time, for a process that only
// waits.
constexpr std::chrono::seconds most_processor_time{1200}, most_time{7200};

std::string environment(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : otherwise;
}

// Ends the program if a scene hangs, and names it.
class Watchdog {
public:
  Watchdog()
      : thread_([this](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            std::this_thread::sleep_for(std::chrono::seconds(1));
            if (std::chrono::steady_clock::now() - begin_.load() < most_time &&
                processor_time() - processor_begin_.load() < most_processor_time)
              continue;
            const std::scoped_lock lock(mutex_);
            std::cerr << fmt::format("scene {} hangs\n", scene_);
            std::_Exit(1);
          }
        }) {}
  void begin(const std::string& scene) {
    {
      const std::scoped_lock lock(mutex_);
      scene_ = scene;
    }
    begin_ = std::chrono::steady_clock::now();
    processor_begin_ = processor_time();
  }

private:
  static std::chrono::seconds processor_time() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return std::chrono::seconds(time.tv_sec);
  }

  std::atomic<std::chrono::steady_clock::time_point> begin_ = std::chrono::steady_clock::now();
  std::atomic<std::chrono::seconds> processor_begin_{};
  std::mutex mutex_;
  std::string scene_;
  std::jthread thread_; // last: it uses the others
};

SceneNumber scene_number(const std::string& name) {
  const auto dash = name.find('-');
  REQUIRE(dash != std::string::npos);
  return {std::stoull(name.substr(0, dash)), std::stoull(name.substr(dash + 1))};
}

std::vector<SceneNumber> wanted_scenes() {
  std::vector<SceneNumber> scenes;
  std::istringstream only(environment("PHLUX_RANDOM_ONLY", ""));
  for (std::string name; only >> name;) scenes.push_back(scene_number(name));
  if (!scenes.empty()) return scenes;
  const std::uint64_t count = std::stoull(environment("PHLUX_RANDOM_SCENES", "2000"));
  for (std::uint64_t i = 0; i < count; ++i) scenes.push_back({i / members, i % members});
  return scenes;
}

struct Table {
  std::size_t scenes = 0;     ///< whole ones
  int pairs = 0, excused = 0; ///< of scenes, without those of twins
  std::set<std::string> families;
};

Table read_table(const std::string& path) {
  std::ifstream stream(path);
  Table table;
  for (std::string line; std::getline(stream, line);) {
    const std::string scene = line.substr(0, line.find(','));
    if (line.find(",done,") != std::string::npos) ++table.scenes;
    const bool excused =
        line.find("," + std::string(name_of(Outcome::not_comparable)) + ",") != std::string::npos ||
        line.find("," + std::string(name_of(Outcome::undecided)) + ",") != std::string::npos;
    const bool agrees = line.find("," + std::string(name_of(Outcome::agree)) + ",") != std::string::npos;
    if (scene.ends_with(" twin") || !(excused || agrees)) continue;
    ++table.pairs;
    if (excused) ++table.excused;
    table.families.insert(scene.substr(0, scene.find('-')));
  }
  return table;
}

std::string lines_of(const SceneAgreement& agreement) {
  std::string text;
  for (const PairOfMethods& pair : agreement.pairs)
    text += fmt::format("{},{},{},{},{},{},{:.3f},{:.3g},{:.3g},\"{}\"\n", agreement.name, pair.first,
                        pair.second, pair.doubts, name_of(pair.outcome), pair.samples_per_pixel, pair.z,
                        pair.difference, pair.p, pair.worst);
  for (const std::string& defect : agreement.defects)
    text += fmt::format("{},,,,defect,,,,,\"{}\"\n", agreement.name, defect);
  return text;
}

} // namespace

TEST_CASE("a long run of random scenes", "[.long]") {
  spdlog::set_level(spdlog::level::err);
  const std::string table = environment("PHLUX_RANDOM_TABLE", "random-scenes.csv");
  const std::vector<SceneNumber> scenes = wanted_scenes();
  Watchdog watchdog;
  const std::size_t first = read_table(table).scenes;
  std::ofstream stream(table, std::ios::app);
  if (first == 0) stream << "scene,first,second,doubts,outcome,samples_per_pixel,z,difference,p,worst\n";
  for (std::size_t i = first; i < scenes.size(); ++i) {
    const SceneNumber number = scenes[i];
    watchdog.begin(name_of(number));
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<SceneAgreement> all = agreement_with_twin(number, methods, samples_per_pixel);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    for (const SceneAgreement& agreement : all) {
      stream << lines_of(agreement);
      INFO(agreement.message());
      CHECK(agreement.holds());
    }
    stream << fmt::format("{},,,,done,,,,,\"{:.1f} s\"\n", name_of(number), seconds.count()) << std::flush;
  }
  const Table all = read_table(table);
  CAPTURE(all.pairs, all.excused, all.families.size());
  CHECK(all.excused <= most_excused(all.families.size()) * all.pairs);
}

// PHLUX_RANDOM_SCENE: "18-8", or "18-8 twin".
TEST_CASE("a random scene is written to a file", "[.write]") {
  const std::string name = environment("PHLUX_RANDOM_SCENE", "0-0");
  const SceneNumber number = scene_number(name);
  std::optional<Twin> twin;
  if (name.ends_with(" twin")) {
    twin = twin_of(number, methods_of_family(number.family, methods));
    REQUIRE(twin);
  }
  const std::filesystem::path folder = environment("PHLUX_RANDOM_FOLDER", ".");
  std::cout
      << write_scene(random_scene(number, twin), folder, name_of(number) + (twin ? "-twin" : "")).string()
      << '\n';
}
