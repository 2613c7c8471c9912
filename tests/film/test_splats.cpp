// Splats: contributions of paths to pixels in which they did not start.
#include "film/film.h"

#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "film/splat_records.h"
#include "scene/scene_data.h"

using phlux::film::BlockSum;
using phlux::film::Film;
using phlux::film::SplatFolder;
using phlux::film::SplatRecords;

namespace {

using Rgb = std::array<double, 3>;

BlockSum one_sample(float value) {
  return {{value, value, value}, {value * value, value * value, value * value}};
}

// Unbiased variance of the mean of the values, in two passes.
double variance_of_mean(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double x : values) mean += x / n;
  for (const double x : values) squares += (x - mean) * (x - mean);
  return squares / (n - 1) / n;
}

// Records in the format of the device.
struct Records {
  struct Record {
    int pixel, path;
    float value[3];
  };
  std::vector<Record> list;
  std::size_t capacity = 0;

  [[nodiscard]] std::vector<float> words() const {
    std::vector<float> result(capacity * (RECORD_VALUE + 3),
                              -1e30f); // records beyond the count must be ignored
    for (std::size_t i = 0; i < list.size(); ++i) {
      std::memcpy(&result[RECORD_PIXEL * capacity + i], &list[i].pixel, 4);
      std::memcpy(&result[RECORD_PATH * capacity + i], &list[i].path, 4);
      for (std::size_t c = 0; c < 3; ++c) result[(RECORD_VALUE + c) * capacity + i] = list[i].value[c];
    }
    return result;
  }
};

void fold(SplatFolder& folder, const Records& records, std::size_t paths, Film& film) {
  std::vector<float> words = records.words();
  SplatRecords handed;
  handed.words = words.data();
  handed.capacity = records.capacity;
  handed.count = records.list.size();
  handed.paths = paths;
  folder.merge(handed);
  SplatFolder::fold(handed, film);
}

} // namespace

TEST_CASE("A pixel's radiance is its samples' mean and its splats over the paths per pixel of the image") {
  Film film(2, 1);
  film.use_splats();
  film.add(0, one_sample(3), 1);
  film.add(0, one_sample(5), 1);
  film.add_splatting_paths(8); // 4 a pixel
  film.add_splat(0, {2, 4, 6});
  film.add_splat(0, {6, 4, 2});
  CHECK(film.mean(0) == Rgb{4 + 2, 4 + 2, 4 + 2});
  CHECK(film.mean(1) == Rgb{});
  film.set_unit(10);
  CHECK(film.mean(0) == Rgb{60, 60, 60});
}

TEST_CASE("Splats that no path has brought yet add nothing") {
  Film film(2, 1);
  film.use_splats();
  CHECK(film.mean(0) == Rgb{});
  CHECK(film.variance_of_mean(0) == Rgb{});
  CHECK(film.relative_variance() == 0);
  film.add(0, one_sample(3), 1);
  CHECK(film.mean(0) == Rgb{3, 3, 3});
}

TEST_CASE("The variance of a film of splats counts the paths that brought nothing") {
  std::mt19937 random(3);
  constexpr std::size_t pixels = 6;
  constexpr std::uint64_t paths = 120;
  Film film(3, 2);
  film.use_splats();
  film.add_splatting_paths(paths);
  std::vector<double> brought(paths, 0.0);
  for (double& value : brought)
    if (random() % 4 == 0) value = static_cast<double>(random() % 1000) / 100;
  for (const double value : brought)
    if (value > 0) film.add_splat(4, {value, 2 * value, 0});
  double mean = 0;
  for (const double value : brought) mean += value / static_cast<double>(paths);
  const double variance = variance_of_mean(brought) * pixels * pixels;
  CHECK(film.mean(4)[0] == Approx(mean * pixels).epsilon(1e-12));
  CHECK(film.variance_of_mean(4)[0] == Approx(variance).epsilon(1e-12));
  CHECK(film.variance_of_mean(4)[1] == Approx(4 * variance).epsilon(1e-12));
  CHECK(film.variance_of_mean(4)[2] == 0);
  CHECK(film.samples_per_pixel() == 20);
  // Per sample of the pixel: 20 of them.
  CHECK(film.relative_variance() == Approx(20 * variance / std::pow(mean * pixels, 2)).epsilon(1e-12));
  CHECK(film.relative_standard_error() == Approx(std::sqrt(variance) / (mean * pixels)).epsilon(1e-12));
  film.set_unit(3);
  CHECK(film.variance_of_mean(4)[0] == Approx(9 * variance).epsilon(1e-12));
}

TEST_CASE("Own samples and splats of others: two populations, whose variances add") {
  constexpr std::size_t pixels = 4;
  const std::vector<double> own = {1, 4, 2}, others = {0, 0, 5, 0, 7, 0, 0, 0, 1};
  Film film(2, 2);
  film.use_splats();
  film.add_splatting_paths(own.size() + others.size()); // 3 a pixel
  for (const double value : own) film.add(2, one_sample(static_cast<float>(value)), 1);
  for (const double value : others)
    if (value > 0) film.add_splat(2, {value, value, value});
  // Mean of the splats over the 9 paths that started elsewhere: 3 paths per pixel, 3 pixels.
  const double scale = 9.0 / (12.0 / pixels);
  CHECK(film.mean(2)[0] == Approx(7.0 / 3 + 13.0 / 3));
  CHECK(film.variance_of_mean(2)[0] ==
        Approx(variance_of_mean(own) + scale * scale * variance_of_mean(others)).epsilon(1e-12));
}

// The spread of the means of many films matches the estimate of each.
TEST_CASE("Films of samples and splats scatter as their variances say") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  constexpr int films = 4000, samples = 6;
  constexpr std::size_t pixels = 3;
  for (const bool has_own : {false, true}) {
    CAPTURE(has_own);
    std::vector<double> means;
    double said = 0;
    for (int i = 0; i < films; ++i) {
      Film film(3, 1);
      film.use_splats();
      for (std::size_t begin = 0; begin < pixels; ++begin)
        for (int sample = 0; sample < samples; ++sample) {
          // Splats to pixel 0. Half of the paths that start elsewhere reach it.
          const double value = uniform(random) < 0.5 ? uniform(random) : 0;
          if (begin == 0 && has_own)
            film.add(0, one_sample(static_cast<float>(value + 1)), 1);
          else if (value > 0)
            film.add_splat(0, {value, value, value});
        }
      film.add_splatting_paths(pixels * samples);
      means.push_back(film.mean(0)[0]);
      said += film.variance_of_mean(0)[0] / films;
    }
    const double scatter = variance_of_mean(means) * films;
    // The variance of nearly normal means has a relative standard error of sqrt(2 / films) = 2.2%; 5 of them
    // are exceeded with probability 6e-7.
    CHECK(scatter / said == Approx(1).epsilon(0.11));
  }
}

TEST_CASE("A film of splats has a variance once there are two paths for every pixel") {
  Film film(2, 1);
  film.use_splats();
  film.add_splatting_paths(2);
  film.add_splat(0, {1, 1, 1});
  CHECK_FALSE(film.has_variance());
  CHECK(std::isinf(film.relative_standard_error()));
  film.add_splatting_paths(2);
  CHECK(film.has_variance());
  CHECK(std::isfinite(film.relative_standard_error()));
  // If paths start in pixels, each pixel still needs two samples.
  film.add(0, one_sample(1), 1);
  CHECK_FALSE(film.has_variance());
  film.add(0, one_sample(1), 1);
  CHECK_FALSE(film.has_variance());
  film.add(1, one_sample(1), 2);
  CHECK(film.has_variance());
  CHECK(film.samples_per_pixel() == 2);
}

TEST_CASE("Records of one path at one pixel are one splat") {
  Film film(4, 1);
  film.use_splats();
  film.add_splatting_paths(8); // 2 a pixel
  Records records;
  records.capacity = 16;
  records.list = {
      {1, 0, {1, 2, 3}}, {2, 0, {5, 5, 5}}, {1, 1, {4, 4, 4}}, {1, 0, {2, 3, 4}}, {1, 0, {3, 4, 5}}};
  SplatFolder folder;
  fold(folder, records, 2, film);
  CHECK(film.mean(1)[0] == (6 + 4) / 2.0);
  CHECK(film.mean(1)[2] == (12 + 4) / 2.0);
  CHECK(film.mean(2)[0] == 5 / 2.0);
  // Squares of 6 and 4, not of 1, 2, 3 and 4.
  CHECK(film.variance_of_mean(1)[0] == Approx(16 * variance_of_mean({6, 4, 0, 0, 0, 0, 0, 0})));
}

TEST_CASE("Paths of another batch are other paths, and what lies beyond a batch's count does not count") {
  Film film(2, 1);
  film.use_splats();
  film.add_splatting_paths(4);
  SplatFolder folder;
  Records records;
  records.capacity = 8;
  records.list = {{0, 0, {1, 1, 1}}, {0, 0, {1, 1, 1}}, {1, 1, {9, 9, 9}}};
  fold(folder, records, 2, film);
  records.list = {{0, 0, {4, 4, 4}}};
  fold(folder, records, 1, film);
  records.list = {};
  fold(folder, records, 0, film);
  CHECK(film.mean(0)[0] == 3);
  CHECK(film.variance_of_mean(0)[0] == Approx(4 * variance_of_mean({2, 4, 0, 0})));
  CHECK(film.mean(1)[0] == 4.5);
}

TEST_CASE("Random records fold as a table of paths and pixels does") {
  std::mt19937 random(11);
  // Few pixels: many repeated pixels. Many: several pixels per bit of the folder's 64.
  for (const int pixels : {1, 3, 40, 1000}) {
    CAPTURE(pixels);
    Film film(pixels, 1), reference(pixels, 1);
    film.use_splats();
    reference.use_splats();
    SplatFolder folder;
    for (const std::size_t count : {900, 0, 1, 2000}) {
      Records records;
      records.capacity = count + 7;
      constexpr int paths = 30;
      std::map<std::pair<int, int>, Rgb> sums; // of multiples of 1/8: exact in float
      for (std::size_t i = 0; i < count; ++i) {
        Records::Record record{static_cast<int>(random() % static_cast<unsigned>(pixels)),
                               static_cast<int>(random() % paths),
                               {}};
        for (std::size_t c = 0; c < 3; ++c) {
          record.value[c] = static_cast<float>(random() % 64) / 8;
          sums[{record.path, record.pixel}][c] += static_cast<double>(record.value[c]);
        }
        records.list.push_back(record);
      }
      for (const auto& [place, value] : sums)
        reference.add_splat(static_cast<std::size_t>(place.second), value);
      fold(folder, records, paths, film);
      film.add_splatting_paths(static_cast<std::uint64_t>(100 * pixels));
      reference.add_splatting_paths(static_cast<std::uint64_t>(100 * pixels));
    }
    int different = 0;
    for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(pixels); ++pixel)
      different += film.mean(pixel) != reference.mean(pixel) ||
                   film.variance_of_mean(pixel) != reference.variance_of_mean(pixel);
    CHECK(different == 0);
  }
}
