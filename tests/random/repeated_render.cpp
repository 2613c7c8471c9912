#include "random/repeated_render.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "render/schedule.h"
#include "tested_kernels.h"

namespace phlux::test {
namespace {

constexpr int most_tiles = 4; // along each side of the image

// Which of `parts` equal parts of `length` pixels a pixel is in.
int part_of(int pixel, int length, int parts) {
  return pixel * parts / length;
}

device::KernelFiles kernel_files() {
  const std::filesystem::path folder = tested_kernels();
  return folder.empty() ? device::KernelFiles() : device::KernelFiles(folder);
}

// The scenes of a family have the same kernels; building anew what the driver has kept takes 80 ms each time.
const cl::Program& program_for(const device::Device& device, const render::Parts& parts) {
  static std::map<std::map<std::string, std::string>, cl::Program> kept;
  constexpr std::size_t most = 16;
  std::map<std::string, std::string> key = parts.defines();
  key["file"] = parts.file();
  if (const auto found = kept.find(key); found != kept.end()) return found->second;
  if (kept.size() == most) kept.clear();
  return kept.emplace(key, device::build(device, kernel_files(), {parts.file(), parts.defines(), {}}).program)
      .first->second;
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
    const auto tiles = static_cast<std::size_t>(across_ * down_);
    std::vector<double> sums(3 * (tiles + 1)), pixels(tiles + 1);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const auto tile =
            static_cast<std::size_t>(part_of(y, height_, down_) * across_ + part_of(x, width_, across_)) + 1;
        const std::array<double, 3> value = film.mean(static_cast<std::size_t>(y * width_ + x));
        for (const std::size_t into : {std::size_t{0}, tile}) {
          ++pixels[into];
          for (std::size_t c = 0; c < 3; ++c) sums[3 * into + c] += value[c];
        }
      }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= pixels[i / 3];
    return sums;
  }

private:
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
    : scene_(scene), method_(method), device_(device::open_devices({}).front()),
      host_(render::prepare(scene, method.traversal, method.lanes)),
      parts_(render::find_parts(scene, host_.geometry, host_.lights, method, method.lanes)),
      program_(program_for(device_, parts_)) {}

film::Film RepeatedRender::image(std::uint64_t seed, int samples_per_pixel, std::uint64_t& nonfinite) const {
  film::Film film(scene_.camera.width, scene_.camera.height);
  film.set_unit(host_.lights.unit);
  render::Settings settings = method_;
  settings.seed = seed;
  render::Launcher launcher(device_, program_, host_, parts_, settings);
  render::Schedule schedule(static_cast<std::int64_t>(film.pixels().size()), samples_per_pixel);
  while (const auto launch = schedule.next(
             [&](std::int64_t left, int samples) { return launcher.wanted_jobs(left, samples); })) {
    launcher.enqueue(*launch);
    launcher.settle();
    launcher.collect(film);
  }
  nonfinite += launcher.take_counts().nonfinite;
  return film;
}

RepeatedMeans RepeatedRender::means(std::uint64_t seed, int renders, int samples_per_pixel) const {
  const Tiles tiles(scene_.camera.width, scene_.camera.height);
  RepeatedMeans result;
  result.names = tiles.names();
  result.renders = renders;
  std::vector<std::vector<double>> all;
  for (int i = 0; i < renders; ++i) {
    std::uint64_t nonfinite = 0;
    const film::Film film = image(seed + static_cast<std::uint64_t>(i), samples_per_pixel, nonfinite);
    if (result.defect.empty()) result.defect = defect_of(film, nonfinite);
    all.push_back(tiles.means(film));
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
