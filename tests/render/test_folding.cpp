// Launches that several threads add to the film.
#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "in_parallel.h"
#include "render/launch_result.h"
#include "scene/scene_data.h"

using namespace phlux;
using namespace phlux::render;

namespace {

constexpr int width = 70, height = 90, pixels = width * height; // six rows of tiles
constexpr std::size_t batch_jobs = 500;

enum class Kind { path, light, bidir };

// The results of a launch whose jobs and splats are random.
LaunchResult random_result(std::mt19937& random, Kind kind, const Launch& launch) {
  LaunchResult result;
  result.launch = launch;
  result.rays = random();
  const auto real = [&] {
    return std::ldexp(static_cast<float>(random() % 1000), -static_cast<int>(random() % 40));
  };
  const auto now_and_then = [&] { return random() % 5000 == 0; };
  if (kind != Kind::light)
    for (std::int64_t job = 0; job < launch.jobs; ++job) {
      film::BlockSum& sum = result.sums.emplace_back();
      for (std::size_t channel = 0; channel < 3; ++channel)
        sum.radiance_squared[channel] = sum.radiance[channel] = real();
      sum.nonfinite = now_and_then() ? 2.0F : 0.0F;
    }
  if (kind == Kind::path) return result;
  result.batch_jobs = batch_jobs;
  result.record_words = RECORD_VALUE + 3;
  const std::size_t batches = (static_cast<std::size_t>(launch.jobs) + batch_jobs - 1) / batch_jobs;
  const std::size_t paths = batch_jobs * static_cast<std::size_t>(launch.block_samples);
  const std::size_t capacity = 2 * paths;
  auto words = std::make_shared<float[]>(batches * result.record_words * capacity);
  for (std::size_t batch = 0; batch < batches; ++batch) {
    float* const own = words.get() + batch * result.record_words * capacity;
    const std::size_t count = random() % capacity;
    for (std::size_t i = 0; i < count; ++i) {
      own[RECORD_PIXEL * capacity + i] = std::bit_cast<float>(static_cast<std::uint32_t>(random() % pixels));
      own[RECORD_PATH * capacity + i] = std::bit_cast<float>(static_cast<std::uint32_t>(random() % paths));
      for (std::size_t channel = 0; channel < 3; ++channel)
        own[(RECORD_VALUE + channel) * capacity + i] =
            now_and_then() ? std::numeric_limits<float>::infinity() : real();
      if (i > 0 && random() % 4 == 0) // a second splat of the path onto the pixel
        for (const std::size_t array : {RECORD_PIXEL, RECORD_PATH})
          own[array * capacity + i] = own[array * capacity + i - 1];
    }
    result.batches.push_back({own, capacity, count, paths});
  }
  result.memory = std::move(words);
  return result;
}

// Appends the bytes of what a film writes.
struct Bytes {
  std::string bytes;

  template<class... Values>
  void operator()(Values&... values) {
    (append(values), ...);
  }
  template<class Value>
  void append(Value& value) {
    if constexpr (requires { value.serialize(*this); })
      value.serialize(*this);
    else
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void append(std::optional<double>& value) { bytes += value ? std::to_string(*value) : "none"; }
  template<class Value, std::size_t n>
  void append(std::array<Value, n>& values) {
    for (Value& value : values) append(value);
  }
};

struct Folded {
  std::string film;
  std::vector<std::uint64_t> nonfinite;
  std::vector<std::int64_t> first_nonfinite; // pixels and samples
};

// Folds the same eight launches by so many threads.
Folded fold(Kind kind, std::size_t threads, bool point_sets, bool clamps) {
  film::Film film(width, height);
  if (point_sets) film.use_dependent_samples();
  if (clamps) film.set_clamp(10.0);
  ResultFolder folder(pixels, false, threads);
  std::mt19937 random(5);
  Folded folded;
  std::int64_t place = 0;
  for (int i = 0; i < 8; ++i) {
    // Launches begin and end anywhere in the image, and have several blocks of a pixel.
    const Launch launch{place % pixels, (kind == Kind::path ? 30'001 : 9001) + i, 100 * i, 4};
    LaunchResult result = random_result(random, kind, launch);
    const Counts counts = folder.fold(result, film);
    CHECK(counts.paths == static_cast<std::uint64_t>(launch.jobs * launch.block_samples));
    CHECK(counts.rays == result.rays);
    folded.nonfinite.push_back(counts.nonfinite);
    REQUIRE(counts.first_nonfinite);
    folded.first_nonfinite.push_back(counts.first_nonfinite->pixel);
    folded.first_nonfinite.push_back(counts.first_nonfinite->sample);
    place += launch.jobs;
  }
  Bytes bytes;
  film.serialize(bytes);
  folded.film = bytes.bytes;
  return folded;
}

} // namespace

TEST_CASE("the film is the same, to the last bit, with any number of threads that add to it") {
  for (const Kind kind : {Kind::path, Kind::light, Kind::bidir})
    for (const bool point_sets : {false, true})
      for (const bool clamps : {false, true}) {
        CAPTURE(static_cast<int>(kind), point_sets, clamps);
        const Folded one = fold(kind, 1, point_sets, clamps);
        for (const std::size_t threads : {2, 3, 40}) {
          const Folded several = fold(kind, threads, point_sets, clamps);
          CHECK((several.film == one.film));
          CHECK(several.nonfinite == one.nonfinite);
          CHECK(several.first_nonfinite == one.first_nonfinite);
        }
      }
}

TEST_CASE("threads do each step once, and pass on an exception") {
  for (const std::size_t threads : {1, 2, 5}) {
    std::vector<std::atomic<int>> done(100);
    in_parallel(threads, done.size(),
                [&](std::size_t step, std::size_t thread) { done[step] += thread < threads ? 1 : 100; });
    CHECK(std::ranges::all_of(done, [](const auto& times) { return times == 1; }));
    CHECK_THROWS_AS(in_parallel(threads, 10,
                                [](std::size_t step, std::size_t) {
                                  if (step == 3) throw std::length_error("step 3");
                                }),
                    std::length_error);
  }
}
