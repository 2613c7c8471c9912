// The same seed gives the same image bit for bit; another seed another one.
#include <cstdlib>
#include <ranges>

#include <catch2/catch.hpp>

#include "render/scenes.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::test;

namespace {

Render cornell_box(std::uint64_t seed, double launch_seconds = 0.05) {
  render::Settings with = settings(100); // whole blocks of samples and a part of one
  with.seed = seed;
  with.launch_seconds = launch_seconds;
  return render_of(shipped("cornell-box", 33, 17), with);
}

bool same_bits(const film::Film& a, const film::Film& b) {
  return std::ranges::equal(a.pixels(), b.pixels(), [](const film::Pixel& x, const film::Pixel& y) {
    return x.sum == y.sum && x.sum_of_squares == y.sum_of_squares && x.samples == y.samples;
  });
}

// Runs the program in `folder`, in a shell; its exit code.
int run(const TemporaryFolder& folder, const std::string& environment, const std::string& arguments) {
  const std::string command = "cd '" + folder.path().string() + "' && " + environment +
                              " '" PHLUX_PROGRAM "' " + arguments + " >out 2>err";
  return std::system(command.c_str());
}

} // namespace

TEST_CASE("the same seed gives the same bits, whatever the length of launches") {
  const Render first = cornell_box(7, 0.002);
  CHECK(same_bits(cornell_box(7, 0.002).film, first.film));
  CHECK(same_bits(cornell_box(7, 0.2).film, first.film));
  for (const film::Pixel& pixel : first.film.pixels()) CHECK(pixel.samples == 100);
}

TEST_CASE("seeds differ in all of their 64 bits") {
  const Render zero = cornell_box(0);
  for (const std::uint64_t seed :
       {std::uint64_t{1}, std::uint64_t{1} << 31, std::uint64_t{1} << 32, std::uint64_t{1} << 63}) {
    CAPTURE(seed);
    const Render other = cornell_box(seed);
    CHECK_FALSE(same_bits(other.film, zero.film));
    check_agreement(tiles(estimate_of(other.film), 8), tiles(estimate_of(zero.film), 8));
  }
}

TEST_CASE("the number of PoCL's threads does not change a bit") {
  const TemporaryFolder folder;
  const std::string render = "render '" PHLUX_SOURCE_DIR "/scenes/cornell-box.xml' --size 24x24 -n 20 -q -o ";
  REQUIRE(run(folder, "POCL_MAX_PTHREAD_COUNT=1", render + "one.exr") == 0);
  REQUIRE(run(folder, "POCL_MAX_PTHREAD_COUNT=3", render + "three.exr") == 0);
  REQUIRE(run(folder, "", "compare one.exr three.exr --json") == 0);
  CHECK_THAT(TemporaryFolder::read(folder / "out"), Catch::Contains("\"rmse\": 0.0,"));
}
