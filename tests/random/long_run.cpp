// As many random scenes as PHLUX_RANDOM_SCENES says (2000), 40 of each family, by 4 methods each:
//   PHLUX_RANDOM_TABLE=outcomes.csv test_random_scenes "[.long]"
// The table has a line for each pair of methods. A run that was stopped goes on after the last whole scene.
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <thread>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "random/agreement_of_methods.h"
#include "random/random_scene.h"

using namespace phlux::test;

namespace {

constexpr std::uint64_t members = 40;
constexpr int methods = 4, samples_per_pixel = 32;
constexpr std::chrono::seconds longest_scene{600};

std::string environment(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : otherwise;
}

// Ends the program when a scene hangs, naming it.
class Watchdog {
public:
  Watchdog()
      : thread_([this](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            std::this_thread::sleep_for(std::chrono::seconds(1));
            if (std::chrono::steady_clock::now() - begin_.load() < longest_scene) continue;
            std::cerr << fmt::format("scene {} hangs\n", scene_.load());
            std::_Exit(1);
          }
        }) {}
  void begin(std::uint64_t scene) {
    scene_ = scene;
    begin_ = std::chrono::steady_clock::now();
  }

private:
  std::atomic<std::chrono::steady_clock::time_point> begin_ = std::chrono::steady_clock::now();
  std::atomic<std::uint64_t> scene_ = 0;
  std::jthread thread_; // last: it uses the others
};

// The lines of a table, up to the last whole scene; how many scenes they are of.
std::uint64_t scenes_in(const std::string& table) {
  std::ifstream stream(table);
  std::string line;
  std::uint64_t done = 0;
  while (std::getline(stream, line))
    if (line.find(",done") != std::string::npos) ++done;
  return done;
}

std::string lines_of(const SceneNumber& number, const SceneAgreement& agreement, double seconds) {
  std::string text;
  for (const PairOfMethods& pair : agreement.pairs)
    text += fmt::format("{},{},{},{},{},{},{:.3f},{:.3g},{:.3g},\"{}\"\n", name_of(number), pair.first,
                        pair.second, pair.doubts, name_of(pair.outcome), pair.samples_per_pixel, pair.z,
                        pair.difference, pair.p, pair.worst);
  for (const std::string& defect : agreement.defects)
    text += fmt::format("{},,,,defect,,,,,\"{}\"\n", name_of(number), defect);
  return text + fmt::format("{},,,,done,,,,,\"{:.1f} s\"\n", name_of(number), seconds);
}

} // namespace

TEST_CASE("a long run of random scenes", "[.long]") {
  spdlog::set_level(spdlog::level::err);
  const std::uint64_t count = std::stoull(environment("PHLUX_RANDOM_SCENES", "2000"));
  const std::string table = environment("PHLUX_RANDOM_TABLE", "random-scenes.csv");
  Watchdog watchdog;
  const std::uint64_t first = scenes_in(table);
  std::ofstream stream(table, std::ios::app);
  if (first == 0) stream << "scene,first,second,doubts,outcome,samples_per_pixel,z,difference,p,worst\n";
  for (std::uint64_t i = first; i < count; ++i) {
    const SceneNumber number{i / members, i % members};
    watchdog.begin(i);
    const auto begin = std::chrono::steady_clock::now();
    const SceneAgreement agreement =
        agreement_of_methods(load_random_scene(number), methods_of_family(number.family, methods),
                             1000 * number.family + number.member, samples_per_pixel);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    stream << lines_of(number, agreement, seconds.count()) << std::flush;
    INFO("scene " << name_of(number) << "\n" << agreement.message());
    CHECK(agreement.holds());
  }
}

TEST_CASE("a random scene is written to a file", "[.write]") {
  const std::string name = environment("PHLUX_RANDOM_SCENE", "0-0");
  const auto dash = name.find('-');
  REQUIRE(dash != std::string::npos);
  const SceneNumber number{std::stoull(name.substr(0, dash)), std::stoull(name.substr(dash + 1))};
  std::cout << write_scene(random_scene(number), environment("PHLUX_RANDOM_FOLDER", "."), name).string()
            << '\n';
}
