// Batches of paths: every sample of every pixel is taken exactly once, whatever the sizes.
#include <map>
#include <utility>
#include <vector>

#include "device_test.h"
#include "directions.h"

using namespace device_test;

namespace {

struct Sizes {
  int pixels, samples, block_samples, batch_jobs, launch_jobs;
};

// All samples of an image, in launches of whole batches as on the host.
std::map<std::pair<int, int>, int> take_all(const Program& program, Variant v, const Sizes& sizes) {
  Random random(91);
  std::vector<std::uint32_t> words;
  for (std::size_t i = 0; i < 64 * static_cast<std::size_t>(v.width); ++i)
    words.push_back(i < static_cast<std::size_t>(v.width) ? 1 : random.word());
  std::map<std::pair<int, int>, int> times;
  const int jobs = sizes.pixels * (sizes.samples / sizes.block_samples);
  constexpr int first_sample = 1000;
  for (int first = 0; first < jobs; first += sizes.launch_jobs) {
    const int count = std::min(sizes.launch_jobs, jobs - first);
    const int batches = (count + sizes.batch_jobs - 1) / sizes.batch_jobs;
    const auto paths = static_cast<std::size_t>(count * sizes.block_samples);
    std::vector<int> pixels(paths, -1), samples(paths, -1), taken(paths, 0);
    const int first_pixel = first % sizes.pixels;
    const int first_block_sample = first_sample + first / sizes.pixels * sizes.block_samples;
    program.run("take_batches", static_cast<std::size_t>(batches * v.width), sizes.pixels, first_pixel, count,
                first_block_sample, sizes.block_samples, sizes.batch_jobs, table(words), 64, table(pixels),
                table(samples), table(taken));
    for (std::size_t i = 0; i < paths; ++i) {
      REQUIRE(taken[i] == 1);
      times[{pixels[i], samples[i] - first_sample}] += 1;
    }
  }
  return times;
}

} // namespace

// 41 x (1 / 41) is below 1 in float32: division must not use the reciprocal.
TEST_CASE("batches: every sample of every pixel is taken once") {
  for (const Variant v : variants) {
    CAPTURE(v);
    const auto program = program_of("batch.cl", v);
    for (const Sizes& sizes :
         {Sizes{1, 64, 16, 4, 4}, Sizes{1, 40, 1, 7, 21}, Sizes{2, 96, 16, 9, 9}, Sizes{3, 30, 5, 64, 64},
          Sizes{5, 7, 1, 4, 12}, Sizes{17, 48, 16, 8, 24}, Sizes{100, 4, 2, 64, 128},
          Sizes{257, 3, 3, 16, 48}, Sizes{1000, 16, 16, 64, 256}, Sizes{41, 12, 1, 256, 256},
          Sizes{3, 94, 47, 8, 8}}) {
      CAPTURE(sizes.pixels, sizes.samples, sizes.block_samples, sizes.batch_jobs, sizes.launch_jobs);
      const auto times = take_all(program, v, sizes);
      CHECK(times.size() == static_cast<std::size_t>(sizes.pixels * sizes.samples));
      for (const auto& [place, count] : times) {
        REQUIRE(count == 1);
        REQUIRE((place.first >= 0 && place.first < sizes.pixels));
        REQUIRE((place.second >= 0 && place.second < sizes.samples));
      }
    }
  }
}
