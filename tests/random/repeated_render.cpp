#include "random/repeated_render.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tested_kernels.h"

namespace phlux::test {
namespace {

constexpr int most_tiles = 4; // along each side of the image

// Index of the part of a pixel if `length` pixels are divided into `parts` equal parts.
int part_of(int pixel, int length, int parts) {
  return pixel * parts / length;
}

render::Settings by_tested_kernels(render::Settings method) {
  method.kernel_dir = tested_kernels();
  return method;
}

// Three channels of the image, then three of each tile.
class Tiles {
public:
  Tiles(int width, int height)
      : width_(width), height_(height), across_(std::min(width, most_tiles)),
        down_(std::min(height, most_tiles)) {}

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const char channel : {'R', 'G', 'B'}) result.push_back(fmt::format("{} of the image", channel));
    for (int y = 0; y < down_; ++y)
      for (int x = 0; x < across_; ++x)
        for (const char channel : {'R', 'G', 'B'})
          result.push_back(fmt::format("{} of tile {} {}", channel, x, y));
    return result;
  }

  [[nodiscard]] std::vector<double> means(const film::Film& film) const {
    std::vector<double> means =
        sums([&](int x, int y) { return film.mean(static_cast<std::size_t>(y * width_ + x)); });
    const std::vector<double> pixels = this->pixels();
    for (std::size_t i = 0; i < means.size(); ++i) means[i] /= pixels[i];
    return means;
  }

  [[nodiscard]] std::vector<double> pixels() const {
    return sums([](int, int) { return std::array<double, 3>{1, 1, 1}; });
  }

private:
  template<class ValueAt>
  [[nodiscard]] std::vector<double> sums(const ValueAt& value_at) const {
    std::vector<double> sums(3 * static_cast<std::size_t>(across_ * down_ + 1));
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const auto tile =
            static_cast<std::size_t>(part_of(y, height_, down_) * across_ + part_of(x, width_, across_)) + 1;
        const std::array<double, 3> value = value_at(x, y);
        for (const std::size_t into : {std::size_t{0}, tile})
          for (std::size_t c = 0; c < 3; ++c) sums[3 * into + c] += value[c];
      }
    return sums;
  }

  int width_, height_, across_, down_;
};

std::string defect_of(const film::Film& film, std::uint64_t nonfinite) {
  if (nonfinite > 0) return fmt::format("{} contributions are not finite", nonfinite);
  for (std::size_t i = 0; i < film.pixels().size(); ++i)
    for (const double value : film.mean(i))
      if (!std::isfinite(value) || value < 0) return fmt::format("pixel {} is {}", i, value);
  return "";
}

} // namespace

RepeatedRender::RepeatedRender(const scene::Scene& scene, const render::Settings& method)
    : prepared_(scene, by_tested_kernels(method)), width_(scene.camera.width), height_(scene.camera.height) {}

RepeatedMeans RepeatedRender::means(std::uint64_t seed, int renders, int samples_per_pixel) const {
  const Tiles tiles(width_, height_);
  RepeatedMeans result;
  result.names = tiles.names();
  result.pixels = tiles.pixels();
  result.renders = renders;
  std::vector<std::vector<double>> all;
  for (int i = 0; i < renders; ++i) {
    const auto image = prepared_.image(seed + static_cast<std::uint64_t>(i), samples_per_pixel);
    if (result.defect.empty()) result.defect = defect_of(image.film, image.nonfinite);
    all.push_back(tiles.means(image.film));
  }
  result.mean.resize(result.names.size());
  result.variance.resize(result.names.size());
  for (std::size_t q = 0; q < result.names.size(); ++q) {
    for (const auto& one : all) result.mean[q] += one[q] / renders;
    for (const auto& one : all) result.variance[q] += std::pow(one[q] - result.mean[q], 2) / (renders - 1);
  }
  return result;
}

} // namespace phlux::test
